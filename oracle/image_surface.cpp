// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Primary hits of a whole picture, by scan conversion in double.
//
// Every usable triangle is tried on every pixel centre that its outline may hold, with the edge functions and
// depth of image_view.h; the least depth stays, the least index among equals (triangles come in ascending
// order). Nothing is proposed and nothing can be missed: the boxes and spans below only leave out pixels that
// lie outside by far more than rounding (their slack is stated), so the result is that of trying all
// triangles on all pixels. Triangles are not clipped: edge functions are homogeneous and hold for triangles
// that reach behind the camera.
//
// Against bare Embree packets this wins on frame meshes (a pixel costs a few multiplications) and holds its
// own on reference meshes of some million triangles, most of which contain no pixel centre and cost one box.
#include "oracle/image_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::oracle {
namespace {

/// Boxes in the picture are kept in 1/256 px; one such unit of slack covers their rounding.
constexpr double kSubpixels = 256;
constexpr int kBoxSlack = 1;
/// Rows of pixels longer than this are narrowed to the span between edges before they are tried.
constexpr int kNarrowFrom = 12;
/// Slack of a span's end, pixels; the end is computed to some 2⁻⁵⁰ of its distance.
constexpr double kSpanSlackPx = 1;
/// A depth or distance to a side of the frustum below this share of the point's distance may have the wrong
/// sign.
constexpr double kSideSlack = 0x1p-30;

/// Sides of the frustum that a point lies outside of, by more than rounding.
enum Side : std::uint8_t { kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8, kBehind = 16, kNoBox = 32 };

struct Corner {
  std::int32_t x = 0, y = 0;  ///< picture coordinates, 1/256 px, clamped
  std::uint8_t sides = 0;
};

std::int32_t subpixel(double px) {
  constexpr double kLimit = 0x1p20;  // px: far outside of any picture, and in range
  // Truncation of what is made positive first: std::floor is a call on plain x86-64.
  return static_cast<std::int32_t>((std::clamp(px, -kLimit, kLimit) + kLimit) * kSubpixels + 0.5) - (1 << 28);
}

Corner classify(const View& view, Vec3 p, double half_width, double half_height) {
  const Vec3 q = view.local(p);
  const double slack = (std::fabs(q.x) + std::fabs(q.y) + std::fabs(q.z)) * kSideSlack;
  Corner corner;
  const double side_x = q.z * half_width;
  const double side_y = q.z * half_height;
  unsigned sides = 0;
  if (q.x < -side_x - slack) sides |= kLeft;
  if (q.x > side_x + slack) sides |= kRight;
  if (q.y > side_y + slack) sides |= kAbove;
  if (q.y < -side_y - slack) sides |= kBelow;
  if (q.z < -slack) sides |= kBehind;
  if (!(q.z > slack)) {
    sides |= kNoBox;
  } else {
    const Vec2 at = view.project_local(q);
    corner.x = subpixel(at.x);
    corner.y = subpixel(at.y);
  }
  corner.sides = static_cast<std::uint8_t>(sides);
  return corner;
}

/// First and last pixel whose centre lies in [low, high], 1/256 px, within [0, count).
std::pair<int, int> pixels_between(std::int32_t low, std::int32_t high, int count) {
  const int first = (low - kBoxSlack + 127) >> 8;  // ⌈(low − 128) / 256⌉
  const int last = (high + kBoxSlack - 128) >> 8;
  return {std::max(first, 0), std::min(last, count - 1)};
}

/// Pixel columns at which three functions slope·x + row can all be ≥ 0 (sign = 1) or all ≤ 0 (sign = −1),
/// widened.
class Span {
 public:
  Span(const View& view, int first, int last) : view_(view), first_(first), last_(last) {}
  void narrow(double slope, double row, double sign) {
    if (slope == 0) {
      if (row * sign < 0) last_ = first_ - 1;
      return;
    }
    const double column = -row / slope * view_.kappa_px + view_.middle_x_px - 0.5;
    if (slope * sign > 0) {
      if (column > first_)
        first_ = column - kSpanSlackPx >= last_ + 1 ? last_ + 1 : whole(column - kSpanSlackPx, first_);
    } else if (column < last_) {
      last_ = column + kSpanSlackPx < first_ ? first_ - 1 : static_cast<int>(column + kSpanSlackPx) + 1;
    }
  }
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }

 private:
  static int whole(double column, int least) { return std::max(static_cast<int>(column), least); }
  const View& view_;
  int first_, last_;
};

struct Picture {
  const View& view;
  std::vector<double> ray_x, ray_y;
  PixelHits hits;

  Picture(const View& v, int width, int height) : view(v) {
    hits.width = width;
    hits.height = height;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    hits.triangle.assign(pixels, PixelHits::kNoHit);
    hits.depth_m.assign(pixels, std::numeric_limits<double>::infinity());
    for (int x = 0; x < width; ++x) ray_x.push_back(view.ray_x(x + 0.5));
    for (int y = 0; y < height; ++y) ray_y.push_back(view.ray_y(y + 0.5));
  }

  void convert(std::uint32_t triangle, const EdgeFunctions& edges, std::pair<int, int> columns,
               std::pair<int, int> rows) {
    for (int y = rows.first; y <= rows.second; ++y) {
      const double ray = ray_y[static_cast<std::size_t>(y)];
      const double row_a = EdgeFunctions::row_part(edges.a, ray);
      const double row_b = EdgeFunctions::row_part(edges.b, ray);
      const double row_c = EdgeFunctions::row_part(edges.c, ray);
      const std::size_t start = static_cast<std::size_t>(y) * static_cast<std::size_t>(hits.width);
      const auto try_pixels = [&](int first, int last) {
        for (int column = first; column <= last; ++column) {
          const auto i = static_cast<std::size_t>(column);
          const double x = ray_x[i];
          const double depth =
              edges.depth(EdgeFunctions::value(edges.a, x, row_a), EdgeFunctions::value(edges.b, x, row_b),
                          EdgeFunctions::value(edges.c, x, row_c));
          if (depth > 0 && depth < hits.depth_m[start + i]) {
            hits.depth_m[start + i] = depth;
            hits.triangle[start + i] = triangle;
          }
        }
      };
      if (columns.second - columns.first < kNarrowFrom) {
        try_pixels(columns.first, columns.second);
        continue;
      }
      for (const double sign : {1.0, -1.0}) {  // which side of the triangle is seen
        Span span(view, columns.first, columns.second);
        span.narrow(edges.a.x, row_a, sign);
        span.narrow(edges.b.x, row_b, sign);
        span.narrow(edges.c.x, row_c, sign);
        try_pixels(span.first(), std::min(span.last(), columns.second));
      }
    }
  }
};

bool finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::vector<std::uint8_t> usable_triangles(const Mesh& mesh) {
  std::vector<std::uint8_t> usable;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const bool good = std::all_of(v.begin(), v.end(), [&](std::uint32_t index) {
      return index < mesh.positions.size() && finite(mesh.positions[index]);
    });
    if (good) continue;
    if (usable.empty()) usable.assign(mesh.triangles.size(), 1);
    usable[t] = 0;
  }
  return usable;
}

}  // namespace

RaySurface::RaySurface(const RayDevice& device, const Mesh& mesh) : state_(std::make_unique<State>()) {
  state_->device = &device;
  state_->mesh = &mesh;
  state_->usable = usable_triangles(mesh);
}

RaySurface::~RaySurface() = default;
RaySurface::RaySurface(RaySurface&&) noexcept = default;
RaySurface& RaySurface::operator=(RaySurface&&) noexcept = default;

const Mesh& RaySurface::mesh() const { return *state_->mesh; }

PixelHits RaySurface::look(const Camera& camera) const {
  const Mesh& mesh = *state_->mesh;
  const std::vector<std::uint8_t>& usable = state_->usable;
  const View view(camera);
  const int width = camera.width_px;
  const int height = camera.height_px;
  Picture picture(view, width, height);

  std::vector<Corner> corners(mesh.positions.size());
  const double half_width = view.middle_x_px / view.kappa_px;
  const double half_height = view.middle_y_px / view.kappa_px;
  for (std::size_t v = 0; v < corners.size(); ++v) {
    if (finite(mesh.positions[v])) corners[v] = classify(view, mesh.positions[v], half_width, half_height);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!usable.empty() && usable[t] == 0) continue;
    const auto& v = mesh.triangles[t];
    const Corner& a = corners[v[0]];
    const Corner& b = corners[v[1]];
    const Corner& c = corners[v[2]];
    if ((a.sides & b.sides & c.sides & (kLeft | kRight | kAbove | kBelow | kBehind)) != 0) continue;
    std::pair<int, int> columns{0, width - 1};
    std::pair<int, int> rows{0, height - 1};
    if (((a.sides | b.sides | c.sides) & kNoBox) == 0) {
      columns = pixels_between(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), width);
      if (columns.first > columns.second) continue;
      rows = pixels_between(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), height);
      if (rows.first > rows.second) continue;
    }
    const EdgeFunctions edges(view.local(mesh.positions[v[0]]), view.local(mesh.positions[v[1]]),
                              view.local(mesh.positions[v[2]]));
    picture.convert(static_cast<std::uint32_t>(t), edges, columns, rows);
  }
  return std::move(picture.hits);
}

RayHit RaySurface::first_hit(const Camera& camera, double x_px, double y_px) const {
  return state_->tree().first_hit(View(camera), x_px, y_px);
}

std::optional<double> RaySurface::height_at(Vec2 p) const {
  PlanIndex::Cursor cursor;
  return state_->plan_index().top(mesh(), p, cursor);
}

}  // namespace plumbline::oracle
