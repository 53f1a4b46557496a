// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/finding_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::oracle {
namespace {

constexpr double kPanelPx = 220, kMarginPx = 24, kNotePx = 26;
/// Oblique view: how much of a plan depth is left, and how much of it shifts to the right.
constexpr double kDepthShare = 0.45, kShear = 0.25;

bool finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// One view: maps metres to pixels of its panel.
class View {
 public:
  View(const FindingScene& scene, bool oblique, double left_px)
      : oblique_(oblique), height_scale_(scene.height_scale), left_px_(left_px) {
    for (const Vec3& p : scene.mesh.positions) {
      if (finite(p)) include(flat(p));
    }
    for (const auto& loop : scene.domain.loops) {
      for (const Vec2& p : loop) include(flat({p.x, p.y, 0}));
    }
    const double extent = std::max({high_.x - low_.x, high_.y - low_.y, 0.0});
    scale_ = extent > 0 ? kPanelPx / extent : 1;
  }
  [[nodiscard]] Vec2 px(Vec3 p) const {
    const Vec2 q = flat(p);
    return {left_px_ + (q.x - low_.x) * scale_,
            kMarginPx + (kPanelPx - (high_.y - low_.y) * scale_) / 2 + (high_.y - q.y) * scale_};
  }
  [[nodiscard]] bool oblique() const { return oblique_; }

 private:
  [[nodiscard]] Vec2 flat(Vec3 p) const {
    if (!oblique_) return {p.x, p.y};
    return {p.x + kShear * p.y, kDepthShare * p.y + height_scale_ * p.z};
  }
  void include(Vec2 p) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }

  bool oblique_;
  double height_scale_, left_px_, scale_ = 1;
  Vec2 low_{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vec2 high_{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
};

std::string points_of(const View& view, std::span<const Vec3> corners) {
  std::string out;
  for (const Vec3& p : corners) {
    const Vec2 q = view.px(p);
    out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", q.x, q.y);
  }
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += c;
    }
  }
  return out;
}

bool is_witness(const FindingScene& scene, std::size_t triangle) {
  return std::any_of(scene.findings.begin(), scene.findings.end(), [&](const Finding& finding) {
    return std::find(finding.triangles.begin(), finding.triangles.end(), triangle) != finding.triangles.end();
  });
}

void draw_triangle(const FindingScene& scene, const View& view, std::size_t k, std::string& out) {
  std::vector<Vec3> corners;
  for (const std::uint32_t v : scene.mesh.triangles[k]) {
    if (v < scene.mesh.positions.size() && finite(scene.mesh.positions[v]))
      corners.push_back(scene.mesh.positions[v]);
  }
  const bool whole = corners.size() == 3;
  out += fmt::format("<polygon points=\"{}\" class=\"{}\"/>\n", points_of(view, corners),
                     !whole                 ? "rest"
                     : is_witness(scene, k) ? "witness"
                                            : "sound");
}

void draw_finding(const FindingScene& scene, const View& view, const Finding& finding, std::string& out) {
  if (!finding.loop.empty() && !view.oblique()) {
    std::vector<Vec3> loop;
    for (const Vec2& p : finding.loop) loop.push_back({p.x, p.y, 0});
    out += fmt::format("<polygon points=\"{}\" class=\"loop\"/>\n", points_of(view, loop));
  }
  for (const std::uint32_t v : finding.vertices) {
    if (v >= scene.mesh.positions.size() || !finite(scene.mesh.positions[v])) continue;
    const Vec2 q = view.px(scene.mesh.positions[v]);
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" class=\"vertex\"/>", q.x, q.y);
    if (scene.numbers) out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", q.x + 6, q.y - 5, v);
    out += '\n';
  }
  if (!finite(finding.at)) return;
  const Vec2 place = view.px(finding.at);
  if (view.oblique() && finding.gap_m != 0) {
    const Vec2 other = view.px({finding.at.x, finding.at.y, finding.at.z - finding.gap_m});
    out += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"gap\"/>\n",
                       place.x, place.y, other.x, other.y);
  }
  out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"10\" class=\"place\"/>\n", place.x, place.y);
}

std::string draw_view(const FindingScene& scene, const View& view) {
  std::string out;
  for (const auto& loop : scene.domain.loops) {
    std::vector<Vec3> corners;
    for (const Vec2& p : loop) corners.push_back({p.x, p.y, 0});
    if (!view.oblique())
      out += fmt::format("<polygon points=\"{}\" class=\"domain\"/>\n", points_of(view, corners));
  }
  // Witnesses last, so that their edges are not drawn over.
  for (const bool witnesses : {false, true}) {
    for (std::size_t k = 0; k < scene.mesh.triangles.size(); ++k) {
      if (is_witness(scene, k) == witnesses) draw_triangle(scene, view, k, out);
    }
  }
  for (const Finding& finding : scene.findings) draw_finding(scene, view, finding, out);
  return out;
}

std::string note_of(const FindingScene& scene) {
  if (!scene.note.empty() || scene.findings.empty()) return std::string(scene.note);
  const Finding& first = scene.findings.front();
  std::string out = fmt::format("{} {}", static_cast<int>(first.code), finding_name(first.code));
  if (!first.kind.empty()) out += fmt::format(" ({})", first.kind);
  if (!first.vertices.empty()) out += fmt::format(", vertices {}", fmt::join(first.vertices, " "));
  if (!first.triangles.empty()) out += fmt::format(", triangles {}", fmt::join(first.triangles, " "));
  if (first.gap_m != 0) out += fmt::format(", gap {:.3g} m", first.gap_m);
  return out;
}

}  // namespace

std::string finding_picture(const FindingScene& scene) {
  const double width = (scene.oblique ? 2 * kPanelPx + 3 * kMarginPx : kPanelPx + 2 * kMarginPx) + 130;
  const double height = kPanelPx + 2 * kMarginPx + kNotePx;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" role=\"img\">\n<title>{2}</title>\n",
      width, height, escaped(note_of(scene)));
  // Attributes by class of this picture alone: a page may hold many of them.
  out +=
      "<style>.pf-finding polygon{stroke-width:1.2;stroke:#4a5568;stroke-linejoin:round}"
      ".pf-finding .sound{fill:#dbe7f3}.pf-finding .witness{fill:#f6b26b;fill-opacity:.8;stroke:#8a4b00;"
      "stroke-width:2}"
      ".pf-finding .rest{fill:none;stroke:#c2185b;stroke-width:2.5;stroke-dasharray:5 4}"
      ".pf-finding .domain{fill:none;stroke:#111;stroke-dasharray:7 5}"
      ".pf-finding .loop{fill:#e53935;fill-opacity:.35;stroke:#b71c1c;stroke-width:2.5}"
      ".pf-finding .vertex{fill:#b71c1c}.pf-finding .place{fill:none;stroke:#b71c1c;stroke-width:2.5}"
      ".pf-finding .gap{stroke:#b71c1c;stroke-width:4}"
      ".pf-finding text{font:12px sans-serif;fill:#111}</style>\n";
  out += fmt::format(
      "<g class=\"pf-finding\">\n<rect width=\"{:.0f}\" height=\"{:.0f}\" rx=\"8\" fill=\"#fcfcf8\"/>\n",
      width, height);
  out += draw_view(scene, View(scene, false, kMarginPx));
  if (scene.oblique) out += draw_view(scene, View(scene, true, 2 * kMarginPx + kPanelPx));
  out += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n</g>\n</svg>\n", kMarginPx, height - 14,
                     escaped(note_of(scene)));
  return out;
}

}  // namespace plumbline::oracle
