// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Each finding of the catalogue has a definition, an example that has exactly this finding, a near twin that
// has none, and a picture drawn from the example. PLUMBLINE_WRITE_GOLDEN=1 writes pictures, docs/findings.md
// and those examples that are folders anew.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/conformity.h"
#include "oracle/finding.h"
#include "oracle/finding_picture.h"
#include "oracle/image.h"
#include "oracle/soundness.h"
#include "properties/atlas/case_file.h"
#include "properties/check/check.h"
#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"
#include "scenarios/pose.h"
#include "tests/properties/finding_corpus.h"

namespace plumbline {
namespace {

using oracle::Finding;
using oracle::FindingCode;
using oracle::FindingDescription;
namespace fs = std::filesystem;

const fs::path kRoot = PLUMBLINE_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

PlanDomain promised_square() {
  PlanDomain domain;
  domain.add_rectangle({0, 0}, {6, 6});
  return domain;
}

/// What was judged, and what was found.
struct Judged {
  Mesh mesh;
  PlanDomain domain;
  std::vector<Finding> findings;
  std::string picture{};  ///< drawn already
};

Judged judge_law(const fs::path& path) {
  const properties::Case c = properties::load_case(path);
  const properties::ReplayResult replayed = properties::replay(c);
  EXPECT_TRUE(replayed.confirmed) << path << ": " << replayed.difference;
  Judged judged{reference_mesh(c.input.terrain), full_domain(c.input.terrain), {}};
  if (replayed.outcome.finding) judged.findings.push_back(*replayed.outcome.finding);
  if (replayed.outcome.kind == properties::LawOutcome::Kind::vacuous) {
    Finding nothing;
    nothing.code = FindingCode::nothing_judged;
    nothing.at = c.input.poses.back().look_at;
    judged.findings.push_back(nothing);
  }
  return judged;
}

/// The picture's figures as findings, with the place of the greatest displacement or of the gap.
std::vector<Finding> judge_picture(const Mesh& mesh, const Mesh& truth) {
  const Camera camera = make_camera({3, -6, 5}, {3, 3, 0}, 60, 160, 120);
  const oracle::RayDevice device;
  const oracle::RaySurface ours(device, mesh), reference(device, truth);
  const oracle::PixelHits hits = reference.look(camera);
  oracle::ImageMaps maps;
  const oracle::ImageError error =
      oracle::image_error(camera, reference, hits, ours, ours.look(camera), 1.0, &maps);
  std::vector<Finding> findings;
  const auto at_pixel = [&](std::size_t k) {
    const auto column = static_cast<int>(k) % camera.width_px, row = static_cast<int>(k) / camera.width_px;
    return camera.position + camera.ray_direction(column + 0.5, row + 0.5) * hits.depth_m[k];
  };
  if (error.over_threshold > 0) {
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t k = 0; k < hits.triangle.size(); ++k) {
      const double value = maps.displacement_px.values[k];
      if (!(value > most)) continue;
      most = value;
      worst = k;
    }
    Finding finding;
    finding.code = FindingCode::error_over_threshold;
    finding.at = at_pixel(worst);
    findings.push_back(finding);
  }
  if (error.uncovered_px > 0) {
    Vec3 sum;
    std::size_t count = 0;
    for (std::size_t k = 0; k < hits.triangle.size(); ++k) {
      if (hits.triangle[k] == oracle::PixelHits::kNoHit) continue;
      const Vec3 p = at_pixel(k);
      if (ours.height_at({p.x, p.y})) continue;
      sum = sum + p;
      ++count;
    }
    EXPECT_GT(count, 0u);
    Finding finding;
    finding.code = FindingCode::uncovered;
    finding.at = sum * (1.0 / static_cast<double>(count));
    findings.push_back(finding);
  }
  return findings;
}

/// Everything in the folder as `plumbline check` takes it.
Judged judge_together(const fs::path& folder) {
  CheckRequest request;
  const bool tiles = fs::exists(folder / "layer.json");
  if (tiles) request.inputs = {folder};
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.filename() == "dem.asc") {
      request.terrain = path;
    } else if (path.filename() == "declared_m.txt") {
      request.declared_m = std::stod(text_of(path));
    } else if (path.filename() == "camera.txt") {
      std::string line = text_of(path);
      line.erase(line.find_last_not_of('\n') + 1);
      const Pose pose = parse_pose(line);
      request.camera = {pose.position, pose.look_at, pose.fov_y_deg, pose.width_px, pose.height_px};
    } else if (!tiles) {
      request.inputs.push_back(path);
    }
  }
  std::sort(request.inputs.begin(), request.inputs.end());
  const CheckOutcome outcome = check(request);
  Judged judged;
  for (const verdict::CheckFinding& found : outcome.verdict.findings) {
    judged.findings.push_back(found.finding);
    if (judged.findings.back().at == Vec3{}) judged.findings.back().at = found.at;
  }
  for (const verdict::CheckedMesh& mesh : outcome.verdict.meshes)
    judged.mesh.triangles.resize(mesh.triangles);
  if (!outcome.pictures.spots.empty()) judged.picture = outcome.pictures.spots.front().picture_svg;
  return judged;
}

Judged judge_file(FindingCode code, const fs::path& path, const fs::path& twin) {
  if (fs::is_directory(path)) return judge_together(path);
  if (path.extension() == ".toml") return judge_law(path);
  Judged judged{triangulate(read_mesh_file(path)), promised_square(), {}};
  if (code == FindingCode::bad_index && path != twin) judged.mesh.positions.pop_back();
  if (code == FindingCode::non_manifold) {
    judged.domain.clear();
    judged.findings = oracle::check_soundness(judged.mesh).findings;
  } else if (code == FindingCode::error_over_threshold || code == FindingCode::uncovered) {
    judged.findings = judge_picture(judged.mesh, triangulate(read_mesh_file(twin)));
  } else {
    judged.findings = oracle::check_conformity(judged.mesh, judged.domain).findings;
  }
  return judged;
}

std::string drawn(FindingCode code, const Judged& judged) {
  if (!judged.picture.empty()) return judged.picture;
  const bool oblique = code == FindingCode::crack || code == FindingCode::non_manifold ||
                       code == FindingCode::error_over_threshold;
  // What it would say of itself is longer than the picture is wide.
  const std::string note = code == FindingCode::nothing_judged ? "110 nothing_judged" : "";
  return oracle::finding_picture({judged.mesh, judged.domain, judged.findings, oblique, note});
}

bool writing() { return std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr; }

void expect_file(const fs::path& path, const std::string& text) {
  if (writing()) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  EXPECT_EQ(text_of(path), text) << path
                                 << " is not what the code prints; PLUMBLINE_WRITE_GOLDEN=1 writes it";
}

class FindingCatalogue : public testing::TestWithParam<FindingDescription> {
 protected:
  [[nodiscard]] fs::path example() const { return kRoot / oracle::finding_example(GetParam().code); }
  [[nodiscard]] fs::path twin() const { return kRoot / oracle::finding_twin(GetParam().code); }
};

TEST_P(FindingCatalogue, ExampleHasExactlyThisFinding) {
  ASSERT_TRUE(fs::exists(example())) << example();
  EXPECT_GT(GetParam().definition.size(), 20u);
  const Judged judged = judge_file(GetParam().code, example(), twin());
  EXPECT_FALSE(judged.findings.empty());
  for (const Finding& finding : judged.findings) {
    EXPECT_EQ(finding.code, GetParam().code) << oracle::finding_name(finding.code) << ' ' << finding.kind;
    const bool placed = !finding.vertices.empty() || !finding.triangles.empty() || !finding.loop.empty() ||
                        !(finding.at == Vec3{});
    EXPECT_TRUE(placed) << "no place";
  }
  expect_file(kRoot / "docs" / oracle::finding_image(GetParam().code), drawn(GetParam().code, judged));
}

TEST_P(FindingCatalogue, TwinHasNone) {
  ASSERT_TRUE(fs::exists(twin())) << twin();
  const Judged judged = judge_file(GetParam().code, twin(), twin());
  for (const Finding& finding : judged.findings)
    ADD_FAILURE() << oracle::finding_name(finding.code) << ' ' << finding.kind;
  EXPECT_FALSE(judged.mesh.triangles.empty());
}

INSTANTIATE_TEST_SUITE_P(Codes, FindingCatalogue, testing::ValuesIn(oracle::finding_catalogue()),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST(FindingCataloguePage, IsWhatTheCodePrints) {
  expect_file(kRoot / "docs/findings.md", oracle::findings_manual());
}

TEST(FindingCataloguePage, FoldersAreWhatTheirGeneratorWrites) {
  const fs::path folder = kRoot / "tests/data/findings";
  const test::Files files = test::finding_corpus();
  for (const auto& [name, bytes] : files) expect_file(folder / name, bytes);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (!entry.is_regular_file() || !name.has_parent_path()) continue;
    EXPECT_TRUE(files.contains(name.generic_string())) << name << " was not generated";
  }
}

/// Files of the folder that belong to no code would rot unseen.
TEST(FindingCataloguePage, EveryFileBelongsToACode) {
  std::set<std::string> known;
  for (const FindingDescription& entry : oracle::finding_catalogue()) {
    known.insert(oracle::finding_example(entry.code));
    known.insert(oracle::finding_twin(entry.code));
  }
  for (const auto& file : fs::directory_iterator(kRoot / "tests/data/findings"))
    EXPECT_TRUE(known.contains("tests/data/findings/" + file.path().filename().string())) << file.path();
}

}  // namespace
}  // namespace plumbline
