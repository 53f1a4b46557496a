// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ranges of a layer.json against the files that are there.
#include <algorithm>
#include <tuple>

#include "scenarios/tiles/tile_set.h"

namespace plumbline {
namespace {

/// How much of [0, ends.back()) is covered by intervals whose ends are all among `ends`: a segment tree of
/// counts, each node with what is covered below it. An interval is taken out as it was put in.
class Cover {
 public:
  explicit Cover(std::vector<std::uint64_t> ends)
      : ends_(std::move(ends)), count_(4 * ends_.size(), 0), length_(4 * ends_.size(), 0) {}

  void add(std::uint64_t begin, std::uint64_t end, int by) { add(0, 0, ends_.size() - 1, begin, end, by); }
  [[nodiscard]] std::uint64_t length() const { return length_[0]; }
  [[nodiscard]] bool holds(std::uint64_t y) const {
    if (y < ends_.front() || y >= ends_.back()) return false;
    std::size_t node = 0, low = 0, high = ends_.size() - 1;
    while (count_[node] == 0 && high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      const bool upper = y >= ends_[middle];
      node = 2 * node + (upper ? 2 : 1);
      (upper ? low : high) = middle;
    }
    return count_[node] > 0;
  }

 private:
  void add(std::size_t node, std::size_t low, std::size_t high, std::uint64_t begin, std::uint64_t end,
           int by) {
    if (end <= ends_[low] || ends_[high] <= begin) return;
    if (begin <= ends_[low] && ends_[high] <= end) {
      count_[node] += by;
    } else {
      const std::size_t middle = (low + high) / 2;
      add(2 * node + 1, low, middle, begin, end, by);
      add(2 * node + 2, middle, high, begin, end, by);
    }
    length_[node] = count_[node] > 0  ? ends_[high] - ends_[low]
                    : high - low == 1 ? 0
                                      : length_[2 * node + 1] + length_[2 * node + 2];
  }

  std::vector<std::uint64_t> ends_;
  std::vector<int> count_;
  std::vector<std::uint64_t> length_;
};

using Ranges = std::vector<TileRange>;
using Files = const TileFile*;

/// One level: sweeps x, with the ranges that hold it as intervals of y.
void sweep(const Ranges& ranges, Files file, Files files_end, TileAvailability& out) {
  struct Event {
    std::uint64_t x;
    std::size_t range;
    int by;
  };
  std::vector<Event> events;
  std::vector<std::uint64_t> ends{0, 1};  // an interval at least, for a level without ranges
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    events.push_back({ranges[r].west, r, 1});
    events.push_back({std::uint64_t{ranges[r].east} + 1, r, -1});
    ends.push_back(ranges[r].first_y);
    ends.push_back(std::uint64_t{ranges[r].last_y} + 1);
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return std::tie(a.x, a.range, a.by) < std::tie(b.x, b.range, b.by);
  });
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  Cover cover(ends);
  std::uint64_t present = 0, x = 0;
  const auto files_before = [&](std::uint64_t end) {
    for (; file != files_end && file->address.x < end; ++file) {
      if (cover.holds(file->address.y)) {
        ++present;
      } else {
        ++out.unadvertised;
        if (out.first_unadvertised.size() < TileAvailability::kMostListed)
          out.first_unadvertised.push_back(file->address);
      }
    }
  };
  std::uint64_t advertised = 0;
  for (const Event& event : events) {
    files_before(event.x);
    advertised += (event.x - x) * cover.length();
    x = event.x;
    const TileRange& range = ranges[event.range];
    cover.add(range.first_y, std::uint64_t{range.last_y} + 1, event.by);
  }
  files_before(~std::uint64_t{0});
  out.advertised += advertised;
  out.missing += advertised - present;
}

/// Adds missing tiles of one level, by address. `patience` bounds the steps: ranges that overlap pass over
/// the same tiles again.
void list_missing(const TileSet& set, const Ranges& ranges, std::size_t& patience,
                  std::vector<TileAddress>& out) {
  std::vector<TileAddress> found;
  for (const TileRange& range : ranges) {
    std::size_t of_range = 0;
    for (std::uint64_t x = range.west; x <= range.east && of_range < TileAvailability::kMostListed; ++x) {
      for (std::uint64_t y = range.first_y; y <= range.last_y && of_range < TileAvailability::kMostListed;
           ++y) {
        if (patience == 0) break;
        --patience;
        const TileAddress address{range.level, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
        if (find_tile(set, address) != nullptr) continue;
        found.push_back(address);
        ++of_range;
      }
      if (patience == 0) break;
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const TileAddress& address : found) {
    if (out.size() < TileAvailability::kMostListed) out.push_back(address);
  }
}

}  // namespace

TileAvailability compare_availability(const TileSet& set) {
  TileAvailability out;
  if (!set.layer.advertises) return out;
  std::vector<Ranges> by_level(static_cast<std::size_t>(kDeepestTileLevel) + 1);
  for (const TileRange& range : set.layer.available)
    by_level[static_cast<std::size_t>(range.level)].push_back(range);
  std::size_t patience = 4 * set.tiles.size() + 100 * TileAvailability::kMostListed;
  Files file = set.tiles.data();
  const Files end = file + set.tiles.size();
  for (std::size_t level = 0; level < by_level.size(); ++level) {
    Files next = file;
    while (next != end && next->address.level == static_cast<int>(level)) ++next;
    const std::uint64_t before = out.missing;
    sweep(by_level[level], file, next, out);
    if (out.missing > before && out.first_missing.size() < TileAvailability::kMostListed)
      list_missing(set, by_level[level], patience, out.first_missing);
    file = next;
  }
  return out;
}

}  // namespace plumbline
