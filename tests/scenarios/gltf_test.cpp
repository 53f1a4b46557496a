// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// glTF, by tiny files made here, and by the models of Debian's assimp-testmodels, some of them broken on
// purpose.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kModels = "/usr/share/assimp/models/glTF2/";

template <class T>
std::string raw(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) {
    char copy[sizeof(T)];
    std::memcpy(copy, &value, sizeof(T));
    out.append(copy, sizeof(T));
  }
  return out;
}

std::string chunk(std::uint32_t type, std::string bytes, char padding) {
  while (bytes.size() % 4 != 0) bytes += padding;
  return raw<std::uint32_t>({static_cast<std::uint32_t>(bytes.size()), type}) + bytes;
}

std::string glb(const std::string& json, const std::string& binary) {
  const std::string chunks = chunk(0x4E4F534A, json, ' ') + chunk(0x004E4942, binary, '\0');
  return "glTF" + raw<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
}

/// Four corners of a unit square (48 bytes of floats), then what the test adds.
std::string square() { return raw<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}); }

/// A document of one mesh on that square; the arguments replace its parts.
struct Parts {
  std::string primitives = R"([{"attributes":{"POSITION":0},"indices":1}])";
  std::string nodes = R"([{"mesh":0}])";
  std::string position_accessor = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
  std::string index_accessor = R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"})";
  std::string views = R"([{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}])";
  std::string buffers = R"([{"byteLength":60}])";
  std::string more;
  std::string binary = square() + raw<std::uint16_t>({0, 1, 2, 0, 2, 3});

  [[nodiscard]] std::string json() const {
    return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":)" + primitives + R"(}],"nodes":)" + nodes +
           R"(,"accessors":[)" + position_accessor + "," + index_accessor + R"(],"bufferViews":)" + views +
           R"(,"buffers":)" + buffers + more + "}";
  }
  [[nodiscard]] std::string bytes() const { return glb(json(), binary); }
  [[nodiscard]] MeshFile mesh() const { return parse_mesh(bytes(), "a.glb"); }
};

std::string message(const std::string& bytes, std::string_view name = "a.glb") {
  try {
    parse_mesh(bytes, name);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(std::string(name) + ": "), Not(HasSubstr("\n"))));
    return error.what();
  }
  return "";
}

std::string file_message(const std::filesystem::path& path) {
  try {
    read_mesh_file(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Gltf, ReadsIndicesOfEveryWidthAndNone) {
  Parts parts;
  EXPECT_THAT(parts.mesh().positions,
              ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}));
  EXPECT_THAT(parts.mesh().corners, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(parts.mesh().ends, ElementsAre(3, 6));
  EXPECT_THAT(parts.mesh().part_ends, ElementsAre(2));

  Parts bytes = parts;
  bytes.index_accessor = R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})";
  bytes.binary = square() + raw<std::uint8_t>({0, 1, 2, 0, 2, 3, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(bytes.mesh().corners, parts.mesh().corners);

  Parts words = parts;
  words.index_accessor = R"({"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"})";
  words.views = R"([{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}])";
  words.buffers = R"([{"byteLength":72}])";
  words.binary = square() + raw<std::uint32_t>({0, 1, 2, 0, 2, 3});
  EXPECT_EQ(words.mesh().corners, parts.mesh().corners);

  Parts none = parts;
  none.primitives = R"([{"attributes":{"POSITION":0}}])";
  none.position_accessor = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  EXPECT_THAT(none.mesh().corners, ElementsAre(0, 1, 2));
}

TEST(Gltf, ReadsStripsAndFansAndPassesOverLines) {
  Parts parts;
  parts.index_accessor = R"({"bufferView":1,"componentType":5123,"count":4,"type":"SCALAR"})";
  parts.primitives = R"([{"attributes":{"POSITION":0},"indices":1,"mode":5}])";
  parts.binary = square() + raw<std::uint16_t>({0, 1, 3, 2, 0, 0});
  EXPECT_THAT(parts.mesh().corners, ElementsAre(0, 1, 3, 1, 2, 3));
  parts.binary = square() + raw<std::uint16_t>({0, 1, 1, 2, 0, 0});
  EXPECT_THAT(message(parts.bytes()), HasSubstr("no triangle")) << "only seams";
  parts.primitives = R"([{"attributes":{"POSITION":0},"indices":1,"mode":6}])";
  parts.binary = square() + raw<std::uint16_t>({0, 1, 2, 3, 0, 0});
  EXPECT_THAT(parts.mesh().corners, ElementsAre(1, 2, 0, 2, 3, 0));
  parts.primitives = R"([{"attributes":{"POSITION":0},"indices":1,"mode":1},{"attributes":{"POSITION":0}}])";
  parts.position_accessor = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  EXPECT_EQ(parts.mesh().polygons(), 1U);
  parts.primitives = R"([{"attributes":{"POSITION":0},"mode":7}])";
  EXPECT_THAT(message(parts.bytes()), HasSubstr("unknown mode 7"));
}

TEST(Gltf, PlacesNodesByTheirParents) {
  Parts parts;
  // Moved by 10 along x, then (inside) a quarter turn about z and twice the size.
  parts.nodes =
      R"([{"translation":[10,0,0],"children":[1]},{"mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757],"scale":[2,2,2]}])";
  MeshFile mesh = parts.mesh();
  EXPECT_NEAR(mesh.positions[1].x, 10, 1e-15);
  EXPECT_NEAR(mesh.positions[1].y, 2, 1e-15);
  EXPECT_NEAR(mesh.positions[3].x, 8, 1e-15);
  // By a matrix, column after column: x ↦ (5 − x, y, z) mirrors, so corners turn round.
  parts.nodes = R"([{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]},{"mesh":0}])";
  mesh = parts.mesh();
  EXPECT_EQ(mesh.positions[1], (Vec3{4, 0, 0}));
  EXPECT_THAT(mesh.corners, ElementsAre(0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7));
  EXPECT_THAT(mesh.part_ends, ElementsAre(2, 4));
  const auto pieces = triangulate_parts(mesh);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].positions.size(), 4U);
  EXPECT_EQ(pieces[1].positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(pieces[1].triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  // Only the shown scene counts.
  parts.more = R"(,"scene":1,"scenes":[{"nodes":[0,1]},{"nodes":[1]}])";
  EXPECT_EQ(parts.mesh().polygons(), 2U);
}

TEST(Gltf, ReadsQuantizedPositions) {
  Parts parts;
  parts.primitives = R"([{"attributes":{"POSITION":0}}])";
  parts.views = R"([{"buffer":0,"byteLength":24,"byteStride":8}])";
  parts.buffers = R"([{"byteLength":24}])";
  parts.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  const auto accessor = [](const char* type, bool normalized) {
    return std::string(R"({"bufferView":0,"count":3,"type":"VEC3","componentType":)") + type +
           (normalized ? R"(,"normalized":true})" : "}");
  };
  parts.position_accessor = accessor("5122", true);
  parts.binary = raw<std::int16_t>({0, 0, 0, 9, 32767, 0, -32768, 9, 0, -32767, 0, 9});
  EXPECT_THAT(parts.mesh().positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, -1}, Vec3{0, -1, 0}));
  parts.position_accessor = accessor("5123", false);
  parts.binary = raw<std::uint16_t>({0, 0, 0, 9, 65535, 0, 1, 9, 0, 7, 0, 9});
  EXPECT_THAT(parts.mesh().positions, ElementsAre(Vec3{0, 0, 0}, Vec3{65535, 0, 1}, Vec3{0, 7, 0}));
  parts.position_accessor = accessor("5123", true);
  EXPECT_EQ(parts.mesh().positions[1].x, 1);
  parts.views = R"([{"buffer":0,"byteLength":12,"byteStride":4}])";
  parts.position_accessor = accessor("5120", true);
  parts.binary = raw<std::int8_t>({0, 0, 0, 9, 127, 0, -128, 9, 0, -127, 0, 9}) + std::string(12, '\0');
  EXPECT_THAT(parts.mesh().positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, -1}, Vec3{0, -1, 0}));
  parts.position_accessor = accessor("5121", true);
  EXPECT_EQ(parts.mesh().positions[1].x, 127.0 / 255);
}

TEST(Gltf, TurnsNormalsByTheInverseTranspose) {
  Parts parts;
  parts.primitives = R"([{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}])";
  parts.index_accessor += R"(,{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"})";
  parts.views =
      R"([{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":48}])";
  parts.buffers = R"([{"byteLength":108}])";
  parts.binary += raw<float>({0, 0, 1, 1, 0, 0, 3, 4, 0, 0, 0, 0});
  EXPECT_EQ(parts.mesh().format, "glTF");
  EXPECT_THAT(parts.mesh().normals,
              ElementsAre(Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{3 * 0.2, 4 * 0.2, 0}, Vec3{}));
  // Twice as wide: the slope along x halves. (3/2, 4) has length √(9/4 + 16).
  parts.nodes = R"([{"mesh":0,"scale":[2,1,1],"translation":[7,7,7]}])";
  const Vec3 wide = parts.mesh().normals[2];
  EXPECT_NEAR(wide.x, 1.5 / std::sqrt(18.25), 1e-15);
  EXPECT_NEAR(wide.y, 4 / std::sqrt(18.25), 1e-15);
  // Mirrored, a normal that points out still does.
  parts.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
  EXPECT_EQ(parts.mesh().normals[1], (Vec3{-1, 0, 0}));
  EXPECT_EQ(parts.mesh().normals[0], (Vec3{0, 0, 1}));
  // Flat along z: no direction is left for what stood in the plane.
  parts.nodes = R"([{"mesh":0,"scale":[1,1,0]}])";
  EXPECT_EQ(parts.mesh().normals[1], (Vec3{}));
  EXPECT_EQ(length(parts.mesh().normals[0]), 1);

  // Not every vertex has one, or one that can be read: none, and the surface as before.
  parts.nodes = R"([{"mesh":0}])";
  for (
      const char* primitives :
      {R"([{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}])",
       R"([{"attributes":{"POSITION":0,"NORMAL":2},"indices":1},{"attributes":{"POSITION":0,"NORMAL":0},"indices":1}])",
       R"([{"attributes":{"POSITION":0,"NORMAL":1},"indices":1},{"attributes":{"POSITION":0,"NORMAL":1},"indices":1}])",
       R"([{"attributes":{"POSITION":0,"NORMAL":77},"indices":1},{"attributes":{"POSITION":0,"NORMAL":77},"indices":1}])"}) {
    parts.primitives = primitives;
    EXPECT_TRUE(parts.mesh().normals.empty()) << primitives;
    EXPECT_EQ(parts.mesh().polygons(), 4U);
  }
}

TEST(Gltf, ReadsBuffersInTextAndBesideTheModel) {
  Parts parts;
  // The square's first three corners as base64.
  parts.primitives = R"([{"attributes":{"POSITION":0}}])";
  parts.position_accessor = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  parts.views = R"([{"buffer":0,"byteLength":36}])";
  parts.buffers =
      R"([{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAA"}])";
  EXPECT_THAT(parse_mesh(parts.json(), "a.gltf").positions,
              ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}));
  parts.buffers = R"([{"byteLength":36,"uri":"data:application/octet-stream;base64,AAA*"}])";
  EXPECT_THAT(message(parts.json(), "a.gltf"), HasSubstr("base64"));
  parts.buffers = R"([{"byteLength":36,"uri":"data:;base64,AAAA"}])";
  EXPECT_THAT(message(parts.json(), "a.gltf"), HasSubstr("states 36 bytes, and has 3"));

  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "gltf_beside";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  parts.buffers = R"([{"byteLength":36,"uri":"with%20blank.bin"}])";
  write("a.gltf", parts.json());
  EXPECT_THAT(file_message(folder / "a.gltf"), HasSubstr("'with%20blank.bin' is missing"));
  EXPECT_THAT(message(parts.json(), "a.gltf"), HasSubstr("only bytes were given"));
  write("with blank.bin", square());
  EXPECT_EQ(read_mesh_file(folder / "a.gltf").polygons(), 1U);
  for (const std::string uri :
       {"../gltf_beside/with blank.bin", "/dev/zero", "http://a/b.bin", "", "%2e%2e/a"}) {
    parts.buffers = R"([{"byteLength":36,"uri":")" + uri + R"("}])";
    write("a.gltf", parts.json());
    EXPECT_THAT(file_message(folder / "a.gltf"), HasSubstr("not a file beside the model")) << uri;
  }
  std::filesystem::remove_all(folder);
}

TEST(Gltf, EveryCutIsAClearLine) {
  const std::string bytes = Parts{}.bytes();
  for (std::size_t cut = 0; cut < bytes.size(); ++cut)
    EXPECT_NE(message(bytes.substr(0, cut)), "") << "cut at byte " << cut;
}

// Whatever a byte is turned into, the answer is a mesh or a line; memory is for the sanitizers to see.
TEST(Gltf, EveryDamagedByteIsAMeshOrAClearLine) {
  const std::string bytes = Parts{}.bytes();
  std::size_t refused = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    for (const char value : {'\0', '9', '-', '\xff', '"', '}'}) {
      std::string damaged = bytes;
      damaged[k] = value;
      try {
        const MeshFile mesh = parse_mesh(damaged, "a.glb");
        EXPECT_LE(mesh.corners.size(), 64 * bytes.size());
        for (const std::uint32_t corner : mesh.corners) EXPECT_LT(corner, mesh.positions.size());
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, bytes.size());
}

TEST(Gltf, RefusesWhatItsHeadersPromiseInVain) {
  const auto with = [](const auto& change) {
    Parts parts;
    change(parts);
    return message(parts.bytes());
  };
  const auto position = [&](const std::string& text) {
    return with([&](Parts& p) { p.position_accessor = text; });
  };
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5126,"count":9007199254740992,"type":"VEC3"})"),
              HasSubstr("do not fit"));
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})"),
              HasSubstr("do not fit"));
  EXPECT_THAT(
      position(
          R"({"bufferView":0,"componentType":5126,"count":4,"byteOffset":9007199254740992,"type":"VEC3"})"),
      HasSubstr("do not fit"));
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5126,"count":4,"byteOffset":1e300,"type":"VEC3"})"),
              HasSubstr("not a whole number"));
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5126,"count":-1,"type":"VEC3"})"),
              HasSubstr("accessors[0].count: -1 is not a whole number"));
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"})"),
              HasSubstr("neither SCALAR nor VEC3"));
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5130,"count":4,"type":"VEC3"})"),
              HasSubstr("componentType 5130"));
  EXPECT_THAT(position(R"({"bufferView":0,"componentType":5125,"count":4,"type":"VEC3"})"),
              HasSubstr("cannot hold positions"));
  EXPECT_THAT(position(R"({"bufferView":7,"componentType":5126,"count":4,"type":"VEC3"})"),
              HasSubstr("names bufferViews[7], of 2"));
  EXPECT_THAT(position(R"({"componentType":5126,"count":4000000000,"type":"VEC3"})"),
              HasSubstr("no bufferView"));
  EXPECT_THAT(
      position(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1}})"),
      HasSubstr("sparse"));
  EXPECT_THAT(position("[]"), HasSubstr("no JSON object"));
  const auto views = [&](const std::string& text) { return with([&](Parts& p) { p.views = text; }); };
  EXPECT_THAT(views(R"([{"buffer":0,"byteLength":9007199254740992,"byteOffset":9007199254740992}])"),
              HasSubstr("ends at byte 18014398509481984 of a buffer of 60"));
  EXPECT_THAT(views(R"([{"buffer":0,"byteLength":48,"byteStride":0}])"), HasSubstr("byteStride 0"));
  EXPECT_THAT(views(R"([{"buffer":0,"byteLength":48,"byteStride":4294967296}])"),
              HasSubstr("byteStride 4294967296"));
  EXPECT_THAT(views(R"([{"buffer":3,"byteLength":48}])"), HasSubstr("names buffers[3], of 1"));
  EXPECT_THAT(views("{}"), HasSubstr("bufferViews: is no list"));
  EXPECT_THAT(with([](Parts& p) { p.buffers = R"([{"byteLength":600000}])"; }),
              HasSubstr("states 600000 bytes, and has 60"));
  EXPECT_THAT(with([](Parts& p) {
                p.index_accessor = R"({"bufferView":1,"componentType":5123,"count":5,"type":"SCALAR"})";
              }),
              HasSubstr("5 corners: no whole number of triangles"));
  EXPECT_THAT(with([](Parts& p) {
                p.index_accessor = R"({"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"})";
              }),
              HasSubstr("cannot hold indices"));
  EXPECT_THAT(with([](Parts& p) {
                p.binary = square() + raw<std::uint16_t>({0, 1, 2, 0, 2, 4});
              }),
              HasSubstr("element 5 names vertex 4, of 4"));
  EXPECT_THAT(with([](Parts& p) { p.nodes = R"([{"mesh":0,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}])"; }),
              HasSubstr("not affine"));
  EXPECT_THAT(
      with([](Parts& p) {
        p.nodes =
            R"([{"mesh":0,"scale":[1e308,1,1]},{"mesh":0,"translation":[1e308,0,0],"scale":[1e308,1,1]}])";
      }),
      HasSubstr("not finite"));
  EXPECT_THAT(with([](Parts& p) { p.more = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"; }),
              HasSubstr("KHR_draco_mesh_compression is not read here; save the model without compression"));
  EXPECT_THAT(with([](Parts& p) { p.more = R"(,"extensionsRequired":["EXT_meshopt_compression"])"; }),
              HasSubstr("without compression"));
  EXPECT_THAT(message("{\"asset\":{\"version\":\"1.0\"}}", "a.gltf"), HasSubstr("glTF 2.0 is read"));
  EXPECT_THAT(message(std::string(100000, '['), "a.gltf"), HasSubstr("syntax error"));
  EXPECT_THAT(message("[1e999]", "a.gltf"), HasSubstr("out of range"));
  EXPECT_THAT(message("glTF" + raw<std::uint32_t>({1, 12})), HasSubstr("version 1"));
  EXPECT_THAT(message("glTF" + raw<std::uint32_t>({2, 0xffffffff}) + "    "), HasSubstr("4294967295 bytes"));
}

TEST(Gltf, NodesMustFormTrees) {
  Parts parts;
  parts.nodes = R"([{"mesh":0,"children":[1]},{"children":[0]}])";
  parts.more = R"(,"scenes":[{"nodes":[0]}])";
  EXPECT_THAT(message(parts.bytes()), HasSubstr("nodes[0]: has two parents or is its own ancestor"));
  parts.nodes = R"([{"children":[1,1]},{"mesh":0}])";
  EXPECT_THAT(message(parts.bytes()), HasSubstr("nodes[1]: has two parents"));
  parts.nodes = R"([{"mesh":0,"children":[9]}])";
  EXPECT_THAT(message(parts.bytes()), HasSubstr("names nodes[9], of 1"));
  parts.nodes = R"([{"mesh":4}])";
  EXPECT_THAT(message(parts.bytes()), HasSubstr("names meshes[4], of 1"));
}

// Little data shown by many nodes through many primitives: the square of the file's size, if nothing stops
// it.
TEST(Gltf, MemoryIsBoundedByTheFilesSize) {
  Parts parts;
  std::string nodes = "[", primitives = "[", positions;
  for (int k = 0; k < 500; ++k) {
    nodes += std::string(k == 0 ? "" : ",") + R"({"mesh":0})";
    primitives += std::string(k == 0 ? "" : ",") + R"({"attributes":{"POSITION":0},"indices":1})";
  }
  parts.nodes = nodes + "]";
  parts.primitives = primitives + "]";
  EXPECT_GT(parse_mesh(Parts{}.bytes(), "a.glb").polygons(), 0U);
  std::string binary = square();
  for (int k = 0; k < 3000; ++k) binary += raw<std::uint16_t>({0, 1, 2});
  parts.binary = binary;
  parts.index_accessor = R"({"bufferView":1,"componentType":5123,"count":9000,"type":"SCALAR"})";
  parts.views = R"([{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":18000}])";
  parts.buffers = R"([{"byteLength":18048}])";
  EXPECT_THAT(message(parts.bytes()), HasSubstr("shows its data too often"));
}

TEST(Welded, ClosesSeamsAndDropsWhatCollapses) {
  Mesh mesh;
  mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{1, 2, 3}, {4, 5, 6}, {1, 4, 6}};
  const Mesh closed = welded(mesh);
  EXPECT_EQ(closed.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(closed.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(CutToManifold, GivesEachFanItsVertexAndBadEdgesBorders) {
  // Two triangles that meet in a vertex; three on one edge; two that run the same way.
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_EQ(cut_to_manifold({positions, {{0, 1, 2}, {0, 3, 4}}}).positions.size(), 6U);
  EXPECT_EQ(cut_to_manifold({positions, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}}).positions.size(), 9U);
  EXPECT_EQ(cut_to_manifold({positions, {{0, 1, 2}, {0, 1, 3}}}).positions.size(), 6U);
  const Mesh sound{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(cut_to_manifold(sound).positions, sound.positions);
  EXPECT_EQ(cut_to_manifold(sound).triangles, sound.triangles);
}

TEST(GltfModels, TheTwoCylinderEngine) {
  const MeshFile engine =
      read_mesh_file(std::string(kModels) + "2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
  EXPECT_EQ(engine.polygons(), 121496U);
  EXPECT_EQ(engine.positions.size(), 84657U);
  EXPECT_EQ(engine.part_ends.size(), 67U);
  std::size_t triangles = 0, before = 0, after = 0;
  for (const Mesh& part : triangulate_parts(engine)) {
    const Mesh closed = welded(part);
    triangles += part.triangles.size();
    before += part.positions.size();
    after += closed.positions.size();
  }
  EXPECT_EQ(triangles, 121496U);
  EXPECT_EQ(before, 84657U);
  EXPECT_LT(after, before) << "creases double their vertices";
}

TEST(GltfModels, BoxesOfEveryContainerAreTheSame) {
  const Mesh text = triangulate(read_mesh_file(std::string(kModels) + "BoxTextured-glTF/BoxTextured.gltf"));
  EXPECT_EQ(text.triangles.size(), 12U);
  EXPECT_EQ(welded(text).positions.size(), 8U);
  for (const char* other :
       {"BoxTextured-glTF-Binary/BoxTextured.glb", "BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
    const Mesh mesh = triangulate(read_mesh_file(std::string(kModels) + other));
    EXPECT_EQ(mesh.positions, text.positions) << other;
    EXPECT_EQ(mesh.triangles, text.triangles) << other;
  }
}

TEST(GltfModels, PrimitiveModesCoverTheSameSquare) {
  for (const char* mode : {"04", "05", "06", "11", "12", "13", "14", "15"}) {
    const Mesh mesh = triangulate(
        read_mesh_file(std::string(kModels) + "glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_" +
                       mode + ".gltf"));
    ASSERT_EQ(mesh.triangles.size(), 2U) << mode;
    Vec3 sum;  // twice the area vector: the sum of a square's halves that turn the same way
    for (const auto& [a, b, c] : mesh.triangles)
      sum = sum + cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    EXPECT_NEAR(length(sum), 2, 0.01) << mode;
  }
}

TEST(GltfModels, BrokenOnesAreOneClearLine) {
  for (const auto& [file, line] : std::initializer_list<std::pair<const char*, const char*>>{
           {"RecursiveNodes/RecursiveNodes.gltf", "its own ancestor"},
           {"IndexOutOfRange/IndexOutOfRange.gltf", "names vertex 255, of 24"},
           {"IndexOutOfRange/AllIndicesOutOfRange.gltf", "names vertex 65535, of 24"},
           {"IncorrectVertexArrays/Cube.gltf", "35 corners"},
           {"MissingBin/BoxTextured.gltf", "'BoxTextured0.bin' is missing"},
           {"SchemaFailures/sceneWrongType.gltf", "not a whole number"},
           {"BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "not finite"},
           {"TestNoRootNode/NoScene.gltf", "shows no triangle"},
           {"wrongTypes/badArray.gltf", "no list of primitives"},
           {"draco/2CylinderEngine.gltf", "without compression"}}) {
    const std::string found = file_message(std::string(kModels) + file);
    EXPECT_THAT(found, AllOf(HasSubstr(file), HasSubstr(line), Not(HasSubstr("\n"))));
  }
}

}  // namespace
}  // namespace plumbline
