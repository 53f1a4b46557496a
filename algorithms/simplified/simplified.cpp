// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/simplified/simplified.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline::simplified {
namespace {

/// A mesh with the vertices that no triangle uses left out.
struct Compact {
  Mesh mesh;
  std::vector<std::uint64_t> keys;  ///< indices before
};

Compact without_unused(const Mesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) number[v] = 0;
  }
  Compact out;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(out.keys.size());
    out.mesh.positions.push_back(mesh.positions[v]);
    out.keys.push_back(v);
  }
  for (const auto& [a, b, c] : mesh.triangles)
    out.mesh.triangles.push_back({number[a], number[b], number[c]});
  return out;
}

/// The full mesh and what has been made of it, by triangle count.
class Shelf {
 public:
  Shelf(Mesh full, PlanDomain domain, Simplify simplify)
      : full_(std::move(full)), domain_(std::move(domain)), simplify_(std::move(simplify)) {}

  [[nodiscard]] std::size_t full_count() const { return full_.triangles.size(); }
  [[nodiscard]] const PlanDomain& domain() const { return domain_; }
  std::shared_ptr<const Compact> at(std::size_t triangles) {
    const std::lock_guard lock(mutex_);
    auto& made = made_[triangles];
    if (!made) {
      made = std::make_shared<const Compact>(
          without_unused(triangles >= full_count() ? full_ : simplify_(full_, triangles)));
    }
    return made;
  }

 private:
  Mesh full_;
  PlanDomain domain_;
  Simplify simplify_;
  std::mutex mutex_;
  std::map<std::size_t, std::shared_ptr<const Compact>> made_;
};

class SimplifiedMethod final : public LodMethod {
 public:
  SimplifiedMethod(Simplify simplify, const Settings& settings)
      : simplify_(std::move(simplify)), settings_(settings) {}

  void prepare(const Terrain& terrain) override {
    shelf_ = std::make_shared<Shelf>(reference_mesh(terrain), full_domain(terrain), simplify_);
  }
  void prepare_objects(const std::vector<Mesh>& objects) override {
    Mesh scene;
    for (const Mesh& object : objects) {
      const auto base = static_cast<std::uint32_t>(scene.positions.size());
      scene.positions.insert(scene.positions.end(), object.positions.begin(), object.positions.end());
      for (const auto& [a, b, c] : object.triangles)
        scene.triangles.push_back({base + a, base + b, base + c});
    }
    shelf_ = std::make_shared<Shelf>(std::move(scene), PlanDomain{}, simplify_);
  }

  void update(const Camera& /*camera*/, LodFrame& frame) override {
    frame.clear();
    const auto made = shelf_->at(triangle_count(settings_, threshold_px(), shelf_->full_count()));
    frame.mesh = made->mesh;
    frame.vertex_keys = made->keys;
    frame.domain = shelf_->domain();
  }
  void reset() override {}  // nothing is kept from frame to frame
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    return std::make_unique<SimplifiedMethod>(*this);
  }

 private:
  Simplify simplify_;
  Settings settings_;
  std::shared_ptr<Shelf> shelf_;
};

}  // namespace

std::size_t triangle_count(const Settings& settings, double threshold_px, std::size_t full) {
  const double asked = settings.triangles_at_1px / threshold_px;
  if (!(asked < static_cast<double>(full))) return full;
  return std::max<std::size_t>(2, static_cast<std::size_t>(asked));
}

OptionDescription triangles_option() {
  return {"triangles", "triangles at a threshold of 1 px; other thresholds: this / threshold",
          Settings().triangles_at_1px};
}

Settings read_settings(const std::string& method, const Options& options) {
  const double triangles = option_number(options, "triangles", Settings().triangles_at_1px);
  if (!(triangles >= 2 && triangles <= 1e9))
    throw InputError(fmt::format("{}: option triangles = {} is not inside [2, 10^9]", method, triangles));
  return {triangles};
}

std::unique_ptr<LodMethod> make_simplified(Simplify simplify, const Settings& settings) {
  return std::make_unique<SimplifiedMethod>(std::move(simplify), settings);
}

}  // namespace plumbline::simplified
