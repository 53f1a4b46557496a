// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/selftest/selftest.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "oracle/soundness.h"
#include "properties/faults/faults.h"
#include "properties/faults/measured_faults.h"
#include "properties/faults/seam_faults.h"
#include "properties/selftest/subjects.h"

namespace plumbline::selftest {
namespace {

using faults::Judges;
using faults::Tally;

constexpr auto kConformity = "O1 conformity";
constexpr auto kSeams = "O1 between meshes";
/// Of the kinds between meshes each subject gets every so many in a round; the rest go to other subjects.
constexpr std::size_t kSeamsInTurn = 3;
/// Clean meshes that one task judges.
constexpr std::size_t kCleanBatch = 64;

/// Faults between the halves of a mesh.
void plant_seams(const std::string& subject, std::size_t turn, std::size_t round, std::uint64_t seed,
                 const Judges& judges, const faults::Surface& surface, std::vector<Tally>& tallies) {
  constexpr int kDraws = 8;
  const auto& kinds = faults::seam_faults();
  Random knife(seed, fmt::format("{} in two, round {}", subject, round));
  std::optional<faults::Halves> halves;
  for (int draw = 0; draw < kDraws && !halves; ++draw) halves = faults::cut_in_two(surface, knife);
  if (!halves) return;
  for (std::size_t k = (turn + round) % kSeamsInTurn; k < kinds.size(); k += kSeamsInTurn) {
    Random random(seed, fmt::format("{} into {}, round {}", kinds[k].name, subject, round));
    std::optional<Tally> tally;
    for (int draw = 0; draw < kDraws && !tally; ++draw) tally = kinds[k].trial(judges, *halves, random);
    if (tally) tallies[faults::fault_kinds().size() + k] = *tally;
  }
}

/// All kinds planted one after the other into one mesh of one subject; then those between meshes.
std::vector<Tally> plant_all(const Subject& subject, std::size_t number, std::size_t round,
                             std::uint64_t seed, const Judges& judges) {
  const auto& kinds = faults::fault_kinds();
  std::vector<Tally> tallies(kinds.size() + faults::seam_faults().size());
  Random maker(seed, fmt::format("{}, round {}", subject.name, round));
  const std::optional<faults::Surface> surface = subject.make(maker);
  if (!surface) return tallies;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    Random random(seed, fmt::format("{} into {}, round {}", kinds[k].name, subject.name, round));
    const auto fault = faults::plant(kinds[k].name, surface->mesh, surface->domain, random);
    if (!fault) continue;
    const faults::Score score = faults::score(*fault, judges.conformity(fault->mesh, fault->domain));
    tallies[k] = {1, score.planted, score.found, score.misplaced, score.false_alarms};
  }
  plant_seams(subject.name, number, round, seed, judges, *surface, tallies);
  return tallies;
}

/// One trial of each fault for the oracles that measure. A scene without a place is drawn again.
Tally measure(const faults::MeasuredFault& fault, std::size_t round, std::uint64_t seed,
              const Judges& judges) {
  constexpr int kDraws = 32;
  Random random(seed, fmt::format("{}, round {}", fault.name, round));
  for (int draw = 0; draw < kDraws; ++draw) {
    if (const auto tally = fault.trial(judges, random, random_solid)) return *tally;
  }
  return {};
}

class Selftest {
 public:
  Selftest(const Request& request, const Judges& judges) : request_(request), judges_(judges) {
    score_.seed = request.seed;
    for (const faults::FaultKind& kind : faults::fault_kinds())
      score_.kinds.push_back(entry(kConformity, kind.name, kind.what, kind.sound));
    for (const faults::SeamFault& fault : faults::seam_faults())
      score_.kinds.push_back(entry(kSeams, fault.name, fault.what, fault.sound));
    for (const faults::MeasuredFault& fault : faults::measured_faults())
      score_.kinds.push_back(entry(fault.oracle, fault.name, fault.what, fault.sound));
    for (const Subject& subject : fault_subjects()) score_.makers.push_back({subject.name, 0});
  }

  verdict::SelftestScore run() {
    // Whole rounds, so that the score does not depend on which task was quicker.
    for (std::size_t round = 0; !stopped(); ++round) {
      plant_round(round);
      if (score_.planted() >= request_.faults) break;
    }
    judge_clean_meshes();
    score_.interrupted = stopped();
    return std::move(score_);
  }

 private:
  static verdict::KindScore entry(std::string_view oracle, std::string_view kind, std::string_view what,
                                  bool sound) {
    verdict::KindScore score;
    score.oracle = oracle;
    score.kind = kind;
    score.what = what;
    score.sound = sound;
    return score;
  }

  [[nodiscard]] bool stopped() const { return request_.cancelled != nullptr && *request_.cancelled; }

  void progress(std::size_t done) const {
    if (request_.progress)
      request_.progress(std::min(done, request_.faults + request_.clean), request_.faults + request_.clean);
  }

  void add(std::size_t kind, const Tally& tally) {
    verdict::KindScore& score = score_.kinds[kind];
    score.faults += tally.faults;
    score.expected += tally.expected;
    score.found += tally.found;
    score.misplaced += tally.misplaced;
    score.false_alarms += tally.false_alarms;
  }

  void plant_round(std::size_t round) {
    const auto& subjects = fault_subjects();
    const auto& measured = faults::measured_faults();
    std::vector<std::vector<Tally>> planted(subjects.size());
    std::vector<Tally> trials(measured.size());
    tbb::parallel_for(std::size_t{0}, subjects.size() + measured.size(), [&](std::size_t task) {
      if (stopped()) return;
      if (task < subjects.size()) {
        planted[task] = plant_all(subjects[task], task, round, request_.seed, judges_);
      } else {
        const std::size_t k = task - subjects.size();
        trials[k] = measure(measured[k], round, request_.seed, judges_);
      }
    });
    for (std::size_t s = 0; s < planted.size(); ++s) {
      for (std::size_t k = 0; k < planted[s].size(); ++k) {
        add(k, planted[s][k]);
        score_.makers[s].faults += planted[s][k].faults;
      }
    }
    const std::size_t first = faults::fault_kinds().size() + faults::seam_faults().size();
    for (std::size_t k = 0; k < trials.size(); ++k) add(first + k, trials[k]);
    progress(score_.planted());
  }

  void judge_clean_meshes() {
    const std::size_t batches = (request_.clean + kCleanBatch - 1) / kCleanBatch;
    std::vector<std::size_t> judged(batches), alarms(batches);
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t batch) {
      const std::size_t end = std::min(request_.clean, (batch + 1) * kCleanBatch);
      for (std::size_t number = batch * kCleanBatch; number < end && !stopped(); ++number) {
        Random random(request_.seed, fmt::format("clean mesh {}", number));
        const faults::Surface surface = clean_mesh(number, random);
        alarms[batch] += judges_.conformity(surface.mesh, surface.domain).counts.total() +
                         judges_.soundness(surface.mesh).counts.total();
        ++judged[batch];
      }
      progress(request_.faults + (done += end - batch * kCleanBatch));
    });
    for (std::size_t batch = 0; batch < batches; ++batch) {
      score_.clean_meshes += judged[batch];
      score_.clean_false_alarms += alarms[batch];
    }
  }

  const Request& request_;
  const Judges& judges_;
  verdict::SelftestScore score_;
};

}  // namespace

Request brief_request() {
  Request request;
  request.faults = 0;
  request.clean = 200;
  return request;
}

verdict::SelftestScore run_selftest(const Request& request, const Judges& judges) {
  tbb::task_arena arena(request.jobs > 0 ? request.jobs : tbb::task_arena::automatic);
  verdict::SelftestScore score;
  arena.execute([&] { score = Selftest(request, judges).run(); });
  return score;
}

verdict::SelftestScore run_selftest(const Request& request) {
  return run_selftest(request, faults::real_judges());
}

}  // namespace plumbline::selftest
