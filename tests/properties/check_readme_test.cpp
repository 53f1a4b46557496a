// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// tests/data/check/README.md: each complaint, its files, the command, and what the first line says; what it
// says there is what the program says. PLUMBLINE_WRITE_GOLDEN=1 writes it anew.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/check/check.h"
#include "reports/check_words.h"
#include "scenarios/pose.h"
#include "scenarios/whole_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(PLUMBLINE_SOURCE_DIR) / "tests/data/check";

struct Row {
  std::string number, threads, complaint;
  std::vector<std::string> commands;  ///< behind "plumbline check", from the corpus' folder
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"1",
       "CesiumGS/cesium#7936",
       "Cesium stops rendering; do all tiles have four corners and their edges on 0 and 32767?",
       {"01_tile_corners_and_edges/tiles", "01_tile_corners_and_edges/tiles_twin"}},
      {"2",
       "heremaps/tin-terrain#28",
       "border vertices are not shared, and some lie far closer than a pixel",
       {"02_unshared_border_vertices/obj/*", "02_unshared_border_vertices/obj_twin/*"}},
      {"3",
       "geo-data/cesium-terrain-builder#86",
       "walls at tile joints, which another quality only reverses",
       {"03_walls_at_joints/tiles", "03_walls_at_joints/tiles_reversed", "03_walls_at_joints/tiles_twin"}},
      {"4",
       "geo-data/cesium-terrain-builder#64",
       "wrong normals on the tiles' perimeter",
       {"04_edge_normals/tiles", "04_edge_normals/tiles --strict", "04_edge_normals/tiles_twin --strict"}},
      {"5",
       "mapbox/mapbox-gl-js#10505",
       "gaps exceed the skirt, beside neighbours more than a level apart",
       {"05_gap_exceeds_skirt/tiles --skirt 5", "05_gap_exceeds_skirt/tiles --skirt 30",
        "05_gap_exceeds_skirt/tiles_twin --skirt 5", "05_gap_exceeds_skirt/skirts/*",
        "05_gap_exceeds_skirt/skirts_twin/*"}},
      {"6",
       "maplibre/maplibre-gl-js#1602, #4991",
       "a mended seam is a visible cliff, the mend undone a crack",
       {"06_cliff_or_crack/crack/* --camera 26,4,9:10,4,6",
        "06_cliff_or_crack/cliff/* --camera 26,4,9:10,4,6",
        "06_cliff_or_crack/twin/* --camera 26,4,9:10,4,6"}},
      {"7",
       "mapbox/martini#7, visgl/deck.gl#4236",
       "tiles simplified one by one meet with different edge vertices",
       {"07_independent_edges/ply/*", "07_independent_edges/ply_twin/*"}},
      {"8",
       "kylebarron/pymartini#15, kylebarron/quantized-mesh-encoder#21",
       "the error is far larger than it should be",
       {"08_transposed_matrix/transposed/* --terrain 08_transposed_matrix/dem.asc",
        "08_transposed_matrix/rows_flipped/* --terrain 08_transposed_matrix/dem.asc",
        "08_transposed_matrix/twin/* --terrain 08_transposed_matrix/dem.asc",
        "08_transposed_matrix/refined_elsewhere/* --terrain 08_transposed_matrix/peak.asc --declared 25",
        "08_transposed_matrix/refined_elsewhere_twin/* --terrain 08_transposed_matrix/peak.asc --declared "
        "25"}},
      {"9",
       "zeux/meshoptimizer#346, #698",
       "simplified terrain tiles have flipped, overlapping, thin triangles",
       {"09_flipped_triangles/obj/*", "09_flipped_triangles/obj_twin/*"}},
      {"10",
       "zeux/meshoptimizer#477",
       "degenerate triangles, and wrong ones, from a regular grid",
       {"10_degenerate_triangles/off/*", "10_degenerate_triangles/off_twin/*"}},
      {"11",
       "zeux/meshoptimizer#661, #59, donmccurdy/glTF-Transform#719",
       "the reported error is not what one sees",
       {"11_declared_error/mesh.ply --terrain 11_declared_error/dem.asc --declared 5",
        "11_declared_error/between.ply --terrain 11_declared_error/dem_twin.asc --declared 5",
        "11_declared_error/mesh.ply --terrain 11_declared_error/dem_twin.asc --declared 5",
        "11_declared_error/box.off --reference 11_declared_error/box_reference.off --declared 0.1",
        "11_declared_error/box_twin.off --reference 11_declared_error/box_reference.off --declared 0.1"}},
      {"12",
       "CGAL/cgal#2192, cnr-isti-vclab/meshlab#264",
       "edge collapse makes the surface cut itself",
       {"12_self_intersections/off/*", "12_self_intersections/off_twin/*"}},
      {"19",
       "qgis/QGIS#5454, pelicanmapping/rocky#98, Zylann/godot_voxel#63",
       "how high must skirts be?",
       {"19_least_skirt/tiles --skirt 10", "19_least_skirt/tiles --skirt 18.25",
        "19_least_skirt/tiles_twin"}},
      {"20",
       "CesiumGS/cesium#2318, #3486",
       "split vertices went to one child only; cracks from quantized coordinates",
       {"20_split_vertices/tiles", "20_split_vertices/tiles_twin", "20_split_vertices/rounding"}}};
  return all;
}

CheckRequest request_of(const std::string& command) {
  CheckRequest request;
  request.pictures = false;
  std::istringstream words(command);
  std::string word, value;
  while (words >> word) {
    if (word == "--strict") {
      request.strict = true;
    } else if (word.starts_with("--")) {
      words >> value;
      if (word == "--terrain") request.terrain = kData / value;
      if (word == "--reference") request.reference = kData / value;
      if (word == "--declared") request.declared_m = std::stod(value);
      if (word == "--skirt") request.skirt_m = std::stod(value);
      if (word == "--camera") {
        const Pose pose = parse_pose(value);
        request.camera = {pose.position, pose.look_at, pose.fov_y_deg, pose.width_px, pose.height_px};
      }
    } else if (word.ends_with("/*")) {
      for (const auto& file : fs::directory_iterator(kData / word.substr(0, word.size() - 2)))
        request.inputs.push_back(file.path());
      std::sort(request.inputs.begin(), request.inputs.end());
    } else {
      request.inputs.push_back(kData / word);
    }
  }
  return request;
}

std::string readme() {
  std::string page =
      "# What users complained about\n\n"
      "The acceptance list of `plumbline check`: for each complaint the smallest files with that defect, and "
      "a near twin\n"
      "without it (the last line of each). `tests/properties/acceptance_corpus.h` makes the files,\n"
      "`tests/properties/check_acceptance_test.cpp` holds the verdicts to codes, places and figures, and\n"
      "`tests/properties/check_readme_test.cpp` writes this page: what it says the program said. Commands "
      "are given from\n"
      "this folder.\n";
  for (const Row& row : rows()) {
    page += fmt::format("\n## {}. {}\n\n{}\n\n", row.number, row.complaint, row.threads);
    for (const std::string& command : row.commands) {
      const verdict::CheckVerdict verdict = check(request_of(command)).verdict;
      page += fmt::format("- `plumbline check {}`  \n  {}: {}\n", command,
                          verdict.sound ? "SOUND" : "**FAULTY**", reports::headline_words(verdict));
    }
  }
  return page;
}

TEST(CheckCorpusReadme, IsWhatTheProgramSays) {
  const std::string page = readme();
  if (std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr) write_whole_file(kData / "README.md", page);
  EXPECT_EQ(read_whole_file(kData / "README.md", "text"), page) << "PLUMBLINE_WRITE_GOLDEN=1 writes it";
}

/// A folder that no command names would rot unseen.
TEST(CheckCorpusReadme, NamesEveryFolder) {
  std::set<std::string> named;
  for (const Row& row : rows())
    for (const std::string& command : row.commands)
      named.insert(command.substr(0, command.find_first_of(" *")));
  for (const auto& complaint : fs::directory_iterator(kData)) {
    if (!complaint.is_directory()) continue;
    std::size_t folders = 0;
    for (const auto& entry : fs::directory_iterator(complaint.path())) {
      if (!entry.is_directory()) continue;
      ++folders;
      const std::string name = entry.path().lexically_relative(kData).generic_string();
      EXPECT_TRUE(named.contains(name) || named.contains(name + "/")) << name;
    }
    EXPECT_EQ(folders == 0, complaint.path().filename() == "11_declared_error") << "it has files alone";
  }
  EXPECT_EQ(rows().size(), 14u);
}

}  // namespace
}  // namespace plumbline
