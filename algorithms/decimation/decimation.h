// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "algorithms/lod_method.h"
#include "algorithms/registry.h"

/// What the view-independent reference methods (edge_collapse, meshopt) share: no method, but all of one save
/// the simplifier.
namespace plumbline::decimation {

struct Decimated {
  Mesh mesh;
  std::vector<std::uint64_t> keys;  ///< per vertex: the original vertex that it is, or that survived in it
};

/// One mesh and how it is brought down to a number of triangles. Immutable: flyers on several threads ask it.
class Simplifier {
 public:
  virtual ~Simplifier() = default;
  [[nodiscard]] virtual std::size_t full_triangles() const = 0;
  /// A mesh of about `triangles` triangles: fewer by what one step takes too much, more where the simplifier
  /// finds nothing left to do. The full mesh if `triangles` is no less than that. Depends on `triangles`
  /// alone.
  [[nodiscard]] virtual Decimated at(std::size_t triangles) const = 0;
};

/// Makes a simplifier; `keep_border`: the border's vertices and edges stay as they are. Throws InputError, a
/// line without the method's name, if the mesh cannot be taken.
using MakeSimplifier = std::function<std::shared_ptr<const Simplifier>(const Mesh& mesh, bool keep_border)>;

/// The count rule: triangles_at_1px / τ, rounded down, inside [least, full]. Requires: τ > 0.
std::size_t triangles_for(double triangles_at_1px, double threshold_px, std::size_t full);

inline constexpr double kTrianglesAt1px = 20000;  ///< the option's default
OptionDescription triangles_at_1px_option();
/// Throws InputError unless it is at least 2 and at most 10^9.
double read_triangles_at_1px(const std::string& method, const Options& options);

/// A method that shows one mesh per threshold, whatever the camera. Each is made when first asked for and
/// then shared by all clones.
class ViewIndependent final : public LodMethod {
 public:
  ViewIndependent(std::string name, MakeSimplifier make, double triangles_at_1px)
      : name_(std::move(name)), make_(std::move(make)), triangles_at_1px_(triangles_at_1px) {}
  /// The reference mesh, its border kept: the promised plan region is the whole rectangle.
  void prepare(const Terrain& terrain) override;
  /// Objects share the count by their own triangles; borders are free. A vertex's key is (object << 32) + its
  /// key in the object. Throws InputError, naming object and place, if an object cannot be taken.
  void prepare_objects(const std::vector<Mesh>& objects) override;
  void update(const Camera& camera, LodFrame& frame) override;
  void reset() override {}  // nothing is kept from frame to frame
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    return std::make_unique<ViewIndependent>(*this);
  }

 private:
  struct Prepared {
    std::vector<std::shared_ptr<const Simplifier>> objects;
    PlanDomain domain;
    std::size_t full = 0;                                         // triangles of all objects
    std::mutex lock;                                              // of `made`
    std::map<std::size_t, std::shared_ptr<const LodFrame>> made;  // by number of triangles asked for
  };
  static LodFrame assemble(const Prepared& prepared, std::size_t triangles);

  std::string name_;
  MakeSimplifier make_;
  double triangles_at_1px_;
  std::shared_ptr<Prepared> prepared_;
};

/// Throws InputError (a line without the method's name) if a triangle names a vertex that is not there, or a
/// position is not finite.
void require_sound_indices(const Mesh& mesh);

}  // namespace plumbline::decimation
