// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to the caller

/// Running the program as a user or a CI job does, without a shell between.
namespace plumbline::testing_cli {

struct Outcome {
  int status = -1;  ///< exit status; 128 + signal if one ended the program
  bool timed_out = false;
  double seconds = 0;
  std::string out, err;  ///< standard output, standard error
};

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Whether a program has got as far as to wait for Ctrl-C: SIGINT is bit 1 of the mask of caught signals that
/// Linux tells. A sanitizer's start-up may take a second in which the signal would end the program as it ends
/// any.
inline bool waits_for_interrupt(pid_t program) {
  std::ifstream status("/proc/" + std::to_string(program) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) == 0)
      return ((std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1)) & 1U) != 0;
  }
  return false;
}

/// Each test gets an empty folder of its own, gone afterwards.
class ProgramTest : public ::testing::Test {
 public:
  ProgramTest() {
    std::string name = (std::filesystem::temp_directory_path() / "plumbline-cli-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    folder_ = name;
  }
  ~ProgramTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

 protected:
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// A file of that name and text in the test's folder.
  std::filesystem::path put(const std::string& name, const std::string& bytes) {
    write_file(folder_ / name, bytes);
    return folder_ / name;
  }

  /// Runs `plumbline arguments…` with the test's folder as working directory; killed after `limit_s`.
  /// `meanwhile` is called again and again with the process's id.
  Outcome run(const std::vector<std::string>& arguments, double limit_s = 60,
              const std::function<void(pid_t)>& meanwhile = {}) {
    const std::filesystem::path io = folder_ / ".io";
    std::filesystem::create_directory(io);
    std::vector<std::string> words{PLUMBLINE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, (io / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, (io / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed_s = [start] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    pid_t child = 0;
    const int spawned = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (spawned != 0) throw std::runtime_error(std::string("cannot start ") + argv[0]);

    Outcome outcome;
    int ended = 0;
    while (waitpid(child, &ended, WNOHANG) == 0) {
      if (elapsed_s() > limit_s && !outcome.timed_out) {
        outcome.timed_out = true;
        kill(child, SIGKILL);
      } else if (meanwhile) {
        meanwhile(child);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    outcome.seconds = elapsed_s();
    outcome.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
    outcome.out = read_file(io / "out");
    outcome.err = read_file(io / "err");
    std::filesystem::remove_all(io);
    return outcome;
  }

  /// Everything below the test's folder, relative paths, sorted: what a run left behind.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      names.push_back(std::filesystem::relative(entry.path(), folder_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace plumbline::testing_cli
