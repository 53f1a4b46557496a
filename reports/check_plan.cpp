// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "reports/check_page.h"
#include "reports/check_words.h"
#include "reports/escape.h"

namespace plumbline::reports {
namespace {

using verdict::CheckVerdict;
using verdict::SeamState;
using verdict::SeamVerdict;

constexpr double kWidth = 960, kHeight = 600, kMargin = 14;
constexpr double kCellPx = 8;    ///< of the summary of many meshes
constexpr double kLabelPx = 64;  ///< boxes narrower than this go without their name
constexpr std::size_t kFewestLetters = 6;
constexpr double kLetterPx = 6.2;  ///< of a label
constexpr std::size_t kCirclesOverCells = 24;
constexpr std::size_t kCircles = 200;  ///< findings drawn
constexpr double kLeastRadius = 4.5, kMostRadius = 13;

bool finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y); }
bool drawable(const verdict::CheckedMesh& mesh) { return finite(mesh.box.low) && finite(mesh.box.high); }

/// From plan to picture: one scale for both axes, north up.
class PlanView {
 public:
  explicit PlanView(const CheckVerdict& verdict) {
    for (const verdict::CheckedMesh& mesh : verdict.meshes)
      if (drawable(mesh)) {
        extend(mesh.box.low);
        extend(mesh.box.high);
      }
    for (const verdict::CheckFinding& finding : verdict.findings)
      if (finite(finding.finding.at)) extend(finding.finding.at);
    const double wide = std::max(high_.x - low_.x, 0.0), tall = std::max(high_.y - low_.y, 0.0);
    const double scale = std::min((kWidth - 2 * kMargin) / wide, (kHeight - 2 * kMargin) / tall);
    scale_ = std::isfinite(scale) ? scale : 1;
    width = wide * scale_ + 2 * kMargin;
    height = tall * scale_ + 2 * kMargin;
  }
  [[nodiscard]] Vec2 at(double x, double y) const {
    return {kMargin + (x - low_.x) * scale_, height - kMargin - (y - low_.y) * scale_};
  }
  [[nodiscard]] bool empty() const { return !any_; }

  double width = 0, height = 0;

 private:
  void extend(Vec3 p) {
    low_ = any_ ? Vec2{std::min(low_.x, p.x), std::min(low_.y, p.y)} : Vec2{p.x, p.y};
    high_ = any_ ? Vec2{std::max(high_.x, p.x), std::max(high_.y, p.y)} : Vec2{p.x, p.y};
    any_ = true;
  }

  Vec2 low_, high_;
  double scale_ = 1;
  bool any_ = false;
};

std::string_view style_of(SeamState state) {
  if (state == SeamState::open) return "open";
  return state == SeamState::covered_by_skirt ? "covered" : "watertight";
}

struct Segment {
  Vec2 from, to;
};

/// Where two boxes meet: along the longer side of what they share.
std::optional<Segment> shared_border(const CheckVerdict& verdict, const PlanView& view,
                                     const SeamVerdict& seam) {
  if (seam.mesh >= verdict.meshes.size() || seam.other_mesh >= verdict.meshes.size()) return std::nullopt;
  const verdict::CheckedMesh &a = verdict.meshes[seam.mesh], &b = verdict.meshes[seam.other_mesh];
  if (!drawable(a) || !drawable(b)) return std::nullopt;
  const double x0 = std::max(a.box.low.x, b.box.low.x), x1 = std::min(a.box.high.x, b.box.high.x);
  const double y0 = std::max(a.box.low.y, b.box.low.y), y1 = std::min(a.box.high.y, b.box.high.y);
  const double mx = (x0 + x1) / 2, my = (y0 + y1) / 2;
  if (x1 - x0 < y1 - y0) return Segment{view.at(mx, y0), view.at(mx, y1)};
  return Segment{view.at(x0, my), view.at(x1, my)};
}

/// A label: without the ending, and cut from the left. Empty where too little of it would be left.
std::string short_name(std::string file, std::size_t letters) {
  const std::size_t dot = file.rfind('.');
  if (dot != std::string::npos && dot > file.rfind('/') + 1) file.resize(dot);
  if (file.size() <= letters) return file;
  if (letters < kFewestLetters) return {};
  std::size_t from = file.size() - letters + 1;
  while (from < file.size() && (static_cast<unsigned char>(file[from]) & 0xC0U) == 0x80U) ++from;
  return "…" + file.substr(from);
}

std::string boxes(const CheckVerdict& verdict, const PlanView& view) {
  std::string out;
  for (const verdict::CheckedMesh& mesh : verdict.meshes) {
    if (!drawable(mesh)) continue;
    const Vec2 a = view.at(mesh.box.low.x, mesh.box.high.y), b = view.at(mesh.box.high.x, mesh.box.low.y);
    out += fmt::format(
        "<rect class=\"mesh\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}: {} "
        "triangles</title></rect>\n",
        a.x, a.y, b.x - a.x, b.y - a.y, markup_escape(mesh.file), mesh.triangles);
    if (b.x - a.x < kLabelPx || b.y - a.y < 24 || verdict.meshes.size() == 1) continue;
    const auto letters = static_cast<std::size_t>((b.x - a.x - 12) / kLetterPx);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", a.x + 6, a.y + 16,
                       markup_escape(short_name(mesh.file, letters)));
  }
  return out;
}

/// One path a state, the worst on top.
std::string seam_lines(const CheckVerdict& verdict, const PlanView& view) {
  std::string out;
  for (const SeamState state : {SeamState::watertight, SeamState::covered_by_skirt, SeamState::open}) {
    std::string path;
    for (const SeamVerdict& seam : verdict.seams) {
      if (seam.state != state) continue;
      if (const auto line = shared_border(verdict, view, seam))
        path +=
            fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", line->from.x, line->from.y, line->to.x, line->to.y);
    }
    if (!path.empty()) out += fmt::format("<path class=\"seam {}\" d=\"{}\"/>\n", style_of(state), path);
  }
  return out;
}

/// Cells of the picture with the worst that lies in them; what a cell holds is told when pointed at.
std::string cells(const CheckVerdict& verdict, const PlanView& view) {
  struct Cell {
    std::size_t meshes = 0;
    SeamTotals seams;
  };
  std::map<std::pair<int, int>, Cell> grid;  // row, column
  const auto cell_at = [&](Vec2 p) -> Cell& {
    return grid[{static_cast<int>(p.y / kCellPx), static_cast<int>(p.x / kCellPx)}];
  };
  for (const verdict::CheckedMesh& mesh : verdict.meshes)
    if (drawable(mesh))
      ++cell_at(view.at((mesh.box.low.x + mesh.box.high.x) / 2, (mesh.box.low.y + mesh.box.high.y) / 2))
            .meshes;
  for (const SeamVerdict& seam : verdict.seams)
    if (const auto line = shared_border(verdict, view, seam)) {
      SeamTotals& totals = cell_at((line->from + line->to) * 0.5).seams;
      if (seam.state == SeamState::open) ++totals.open;
      if (seam.state == SeamState::covered_by_skirt) ++totals.covered;
      if (seam.state == SeamState::watertight) ++totals.watertight;
    }
  std::string out;
  for (const auto& [place, cell] : grid) {
    const char* worst = cell.seams.open > 0         ? "open"
                        : cell.seams.covered > 0    ? "covered"
                        : cell.seams.watertight > 0 ? "watertight"
                                                    : "mesh";
    out += fmt::format(
        "<rect class=\"cell {}\" x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\"><title>{} "
        "meshes; seams: {}</title></rect>\n",
        worst, place.second * kCellPx, place.first * kCellPx, kCellPx, kCellPx, cell.meshes,
        seam_totals_words(cell.seams));
  }
  return out;
}

/// The worst findings, drawn last to first; sizes are compared within a code.
std::string circles(const CheckVerdict& verdict, const PlanView& view, std::size_t most_shown) {
  std::map<oracle::FindingCode, double> largest;
  for (const verdict::CheckFinding& finding : verdict.findings) {
    double& most = largest[finding.finding.code];
    most = std::max(most, size_of(finding.finding));
  }
  std::string out;
  for (std::size_t i = std::min(verdict.findings.size(), most_shown); i-- > 0;) {
    const verdict::CheckFinding& finding = verdict.findings[i];
    if (!finite(finding.finding.at)) continue;
    const double most = largest[finding.finding.code];
    const double share = most > 0 ? std::sqrt(size_of(finding.finding) / most) : 0;
    const Vec2 p = view.at(finding.finding.at.x, finding.finding.at.y);
    out += fmt::format(
        "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"><title>{} {}: {}</title></circle>\n",
        finding.finding.severity == oracle::Severity::hazard ? "hazard" : "fault", p.x, p.y,
        kLeastRadius + (kMostRadius - kLeastRadius) * (std::isfinite(share) ? share : 1),
        static_cast<int>(finding.finding.code), code_name(finding.finding.code),
        markup_escape(message_words(finding)));
  }
  return out;
}

}  // namespace

std::string plan_svg(const CheckVerdict& verdict) {
  const PlanView view(verdict);
  if (view.empty()) return {};
  std::string out = fmt::format(
      "<svg class=\"plan\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" "
      "aria-label=\"All meshes in plan\">\n",
      std::max(view.width, 2 * kMargin + 1), std::max(view.height, 2 * kMargin + 1));
  const bool many = verdict.meshes.size() > kPlanBoxes;
  out += many ? cells(verdict, view) : boxes(verdict, view) + seam_lines(verdict, view);
  return out + circles(verdict, view, many ? kCirclesOverCells : kCircles) + "</svg>\n";
}

}  // namespace plumbline::reports
