// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where SQLite enters (§4 of the paper: topology and errors are computed once and kept in a database). The
// one place in a method that touches a file: the paper's preparation is defined by being kept.
#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sqlite3.h>

#include "algorithms/ring_tin/prepared_tin.h"
#include "scenarios/error.h"

namespace plumbline::ring_tin {
namespace {

/// In the file's header (PRAGMA application_id): "PlTN"; user_version counts the layouts.
constexpr int kApplicationId = 0x506c544e;
constexpr int kLayout = 1;

// Columns have no declared type: SQLite then keeps a double as its eight bytes. In a REAL column it would
// store whole numbers as integers, and −0.0 would come back as 0.0.
constexpr const char* kTables =
    "CREATE TABLE source (fingerprint, content);"
    "CREATE TABLE vertex (id INTEGER PRIMARY KEY, x, y, z);"
    "CREATE TABLE triangle (id INTEGER PRIMARY KEY, a, b, c);"
    "CREATE TABLE edge (id INTEGER PRIMARY KEY, a, b, road, error_m, start);";

struct Close {
  void operator()(sqlite3* db) const { sqlite3_close(db); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;

class Statement {
 public:
  Statement(sqlite3* db, const char* sql, std::string file) : db_(db), file_(std::move(file)) {
    sqlite3_stmt* made = nullptr;
    const int status = sqlite3_prepare_v2(db, sql, -1, &made, nullptr);
    statement_.reset(made);
    if (status != SQLITE_OK) fail();
  }
  template <class... Values>
  void insert(Values... values) {
    int column = 0;
    (bind(++column, values), ...);
    if (sqlite3_step(statement_.get()) != SQLITE_DONE) fail();
    sqlite3_reset(statement_.get());
  }
  /// Whether there is a further row.
  bool next() {
    const int status = sqlite3_step(statement_.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) fail();
    return status == SQLITE_ROW;
  }
  [[nodiscard]] double number(int column) const {
    expect(column, SQLITE_FLOAT);
    return sqlite3_column_double(statement_.get(), column);
  }
  [[nodiscard]] std::int64_t integer(int column) const {
    expect(column, SQLITE_INTEGER);
    return sqlite3_column_int64(statement_.get(), column);
  }
  [[nodiscard]] std::uint32_t index(int column, std::size_t count) const {
    const std::int64_t value = integer(column);
    if (value < 0 || static_cast<std::uint64_t>(value) >= count) damaged();
    return static_cast<std::uint32_t>(value);
  }
  [[noreturn]] void damaged() const {
    throw InputError(
        fmt::format("{}: a damaged database of a prepared TIN; delete it, and it will be made anew", file_));
  }

 private:
  void bind(int column, double value) { sqlite3_bind_double(statement_.get(), column, value); }
  void bind(int column, std::int64_t value) { sqlite3_bind_int64(statement_.get(), column, value); }
  void expect(int column, int type) const {
    if (sqlite3_column_type(statement_.get(), column) != type) damaged();
  }
  [[noreturn]] void fail() const { throw InputError(fmt::format("{}: {}", file_, sqlite3_errmsg(db_))); }

  sqlite3* db_;
  std::string file_;
  std::unique_ptr<sqlite3_stmt, Close> statement_;
};

Database open(const std::filesystem::path& path, int flags) {
  sqlite3* made = nullptr;
  const int status = sqlite3_open_v2(path.c_str(), &made, flags, nullptr);
  Database db(made);
  if (status != SQLITE_OK) {
    throw InputError(fmt::format("{}: {}; name a file in a folder that can be written", path.string(),
                                 made != nullptr ? sqlite3_errmsg(made) : "out of memory"));
  }
  return db;
}

void run(sqlite3* db, const std::string& sql, const std::filesystem::path& path) {
  if (sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw InputError(fmt::format("{}: {}", path.string(), sqlite3_errmsg(db)));
  }
}

int header(sqlite3* db, const char* pragma, const std::filesystem::path& path) {
  Statement statement(db, pragma, path.string());
  return statement.next() ? static_cast<int>(statement.integer(0)) : 0;
}

std::int64_t as_signed(std::uint64_t bits) { return std::bit_cast<std::int64_t>(bits); }

/// A number that changes with anything that is stored.
std::uint64_t content(const tin::Tin& network, const Prices& prices) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, eight bytes at a time
  const auto take = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3; };
  for (const Vec3& p : network.mesh.positions) {
    for (const double x : {p.x, p.y, p.z}) take(std::bit_cast<std::uint64_t>(x));
  }
  for (const auto& t : network.mesh.triangles) {
    for (const std::uint32_t v : t) take(v);
  }
  for (const auto& e : network.roads) {
    for (const std::uint32_t v : e) take(v);
  }
  for (const double error_m : prices.error_m) take(std::bit_cast<std::uint64_t>(error_m));
  for (const std::uint8_t start : prices.start) take(start);
  return hash;
}

}  // namespace

void store(const std::filesystem::path& path, const PreparedTin& prepared, std::uint64_t source) {
  // Made beside the file and then renamed: whoever opens it finds it whole.
  std::filesystem::path draft = path;
  draft += fmt::format(".{:016x}.part", source);
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);
  {
    const Database db = open(draft, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    // A draft needs no journal: if it is not finished, it is thrown away.
    run(db.get(), "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;", draft);
    run(db.get(),
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId, kLayout), draft);
    run(db.get(), fmt::format("BEGIN; {}", kTables), draft);
    const std::string name = draft.string();
    const auto number = [](auto index) { return static_cast<std::int64_t>(index); };
    Statement(db.get(), "INSERT INTO source VALUES (?, ?)", name)
        .insert(as_signed(source), as_signed(content(prepared.tin, prepared.prices)));
    const Mesh& mesh = prepared.tin.mesh;
    Statement vertex(db.get(), "INSERT INTO vertex VALUES (?, ?, ?, ?)", name);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      vertex.insert(number(v), mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z);
    }
    Statement triangle(db.get(), "INSERT INTO triangle VALUES (?, ?, ?, ?)", name);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      triangle.insert(number(t), number(a), number(b), number(c));
    }
    Statement edge(db.get(), "INSERT INTO edge VALUES (?, ?, ?, ?, ?, ?)", name);
    const auto& edges = prepared.adjacency.edges();
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      edge.insert(number(e), number(edges[e][0]), number(edges[e][1]),
                  number(prepared.adjacency.is_road(e) ? 1 : 0), prepared.prices.error_m[e],
                  number(prepared.prices.start[e]));
    }
    run(db.get(), "COMMIT;", draft);
  }
  std::error_code failed;
  std::filesystem::rename(draft, path, failed);
  if (failed) {
    std::filesystem::remove(draft, ignored);
    throw InputError(fmt::format("{}: {}; name a file that can be written", path.string(), failed.message()));
  }
}

PreparedTin open_stored(const std::filesystem::path& path, std::uint64_t source, PlanDomain covered) {
  const Database db = open(path, SQLITE_OPEN_READONLY);
  const std::string name = path.string();
  if (header(db.get(), "PRAGMA application_id", path) != kApplicationId ||
      header(db.get(), "PRAGMA user_version", path) != kLayout) {
    throw InputError(fmt::format(
        "{}: not a database of a prepared TIN; name another file, or one that is not there yet", name));
  }
  Statement origin(db.get(), "SELECT fingerprint, content FROM source", name);
  if (!origin.next()) origin.damaged();
  if (origin.integer(0) != as_signed(source)) {
    throw InputError(fmt::format(
        "{}: was prepared from another terrain or other points; name another file, or delete it", name));
  }
  const std::int64_t content_then = origin.integer(1);

  tin::Tin network;
  Statement vertex(db.get(), "SELECT x, y, z FROM vertex ORDER BY id", name);
  while (vertex.next()) {
    network.mesh.positions.push_back({vertex.number(0), vertex.number(1), vertex.number(2)});
  }
  const std::size_t vertices = network.mesh.positions.size();
  Statement triangle(db.get(), "SELECT a, b, c FROM triangle ORDER BY id", name);
  while (triangle.next()) {
    network.mesh.triangles.push_back(
        {triangle.index(0, vertices), triangle.index(1, vertices), triangle.index(2, vertices)});
  }
  Prices prices;
  Statement edge(db.get(), "SELECT a, b, road, error_m, start FROM edge ORDER BY id", name);
  while (edge.next()) {
    const tin::Edge ends{edge.index(0, vertices), edge.index(1, vertices)};
    if (edge.index(2, 2) == 1) network.roads.push_back(ends);
    prices.error_m.push_back(edge.number(3));
    prices.start.push_back(static_cast<std::uint8_t>(edge.index(4, 2)));
  }
  // What was written was sound, so bytes that still sum up to the same are sound too.
  if (as_signed(content(network, prices)) != content_then) edge.damaged();
  PreparedTin prepared(std::move(network), std::move(covered), std::move(prices));
  if (prepared.prices.error_m.size() != prepared.adjacency.edges().size()) edge.damaged();
  return prepared;
}

}  // namespace plumbline::ring_tin
