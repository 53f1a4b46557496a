// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/tiles/quantized_mesh.h"

#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/gzip.h"
#include "scenarios/little_endian.h"
#include "scenarios/portable_math.h"
#include "tests/scenarios/support.h"
#include "tests/scenarios/tile_support.h"

namespace plumbline {
namespace {

using test::input_error;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const TileAddress kPlace{9, 533, 383};

template <class T>
std::string raw(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) append_little_endian(out, value);
  return out;
}

std::string header() {
  return raw<double>({1, 2, 3}) + raw<float>({-5, 95}) + raw<double>({4, 5, 6, 7, 8, 9, 10});
}

/// Two triangles, written out by hand from the specification's text: u 0 32767 32767 0, zig-zag of the deltas
/// 0, 32767, 0, −32767; likewise v and height; codes 0 0 0 and (highest is 3) 3 1 0.
std::string by_hand() {
  return header() + raw<std::uint32_t>({4}) + raw<std::uint16_t>({0, 65534, 0, 65533}) +
         raw<std::uint16_t>({0, 0, 65534, 0}) + raw<std::uint16_t>({0, 20, 9, 65504}) +
         raw<std::uint32_t>({2}) + raw<std::uint16_t>({0, 0, 0, 3, 1, 0}) + raw<std::uint32_t>({2}) +
         raw<std::uint16_t>({0, 3}) + raw<std::uint32_t>({2}) + raw<std::uint16_t>({0, 1}) +
         raw<std::uint32_t>({2}) + raw<std::uint16_t>({1, 2}) + raw<std::uint32_t>({2}) +
         raw<std::uint16_t>({2, 3});
}

std::string extension(std::uint8_t number, const std::string& data) {
  return raw<std::uint8_t>({number}) + raw<std::uint32_t>({static_cast<std::uint32_t>(data.size())}) + data;
}

TEST(QuantizedMesh, DecodesATileWrittenByHand) {
  const std::string bytes = by_hand() + extension(1, std::string("\x80\x80\xff\x80\x80\xff\x00\x00", 8)) +
                            extension(2, "\xff") + extension(9, "what is this") +
                            extension(4, raw<std::uint32_t>({2}) + "{}");
  const QuantizedMesh tile = parse_quantized_mesh(bytes, "a.terrain");
  EXPECT_EQ(tile.center, (Vec3{1, 2, 3}));
  EXPECT_EQ(tile.min_height_m, -5);
  EXPECT_EQ(tile.max_height_m, 95);
  EXPECT_EQ(tile.sphere_center, (Vec3{4, 5, 6}));
  EXPECT_EQ(tile.sphere_radius_m, 7);
  EXPECT_EQ(tile.horizon_occlusion, (Vec3{8, 9, 10}));
  EXPECT_THAT(tile.u, ElementsAre(0, 32767, 32767, 0));
  EXPECT_THAT(tile.v, ElementsAre(0, 0, 32767, 32767));
  EXPECT_THAT(tile.height, ElementsAre(0, 10, 5, 32757));
  EXPECT_EQ(tile.height_m(1), -5 + 100.0 * 10 / 32767);
  EXPECT_THAT(tile.triangles,
              ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2}, std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_THAT(tile.edges[0], ElementsAre(0, 3));
  EXPECT_THAT(tile.edges[1], ElementsAre(0, 1));
  EXPECT_THAT(tile.edges[2], ElementsAre(1, 2));
  EXPECT_THAT(tile.edges[3], ElementsAre(2, 3));
  // Two bytes place a normal within a degree: up, along x, along y, and down (both bytes at an end).
  ASSERT_EQ(tile.normals.size(), 4u);
  const Vec3 expected[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(dot(tile.normals[k], expected[k]), std::cos(kRadiansPerDegree)) << k;
    EXPECT_NEAR(length(tile.normals[k]), 1, 1e-15);
  }
  EXPECT_EQ(tile.water_mask, "\xff");
  EXPECT_EQ(tile.metadata, "{}");
  EXPECT_THAT(tile.extensions, ElementsAre(1, 2, 9, 4));
  EXPECT_EQ(tile.trailing_bytes, 0u);
  EXPECT_EQ(parse_quantized_mesh(bytes + std::string(7, '\0'), "a.terrain").trailing_bytes, 7u);
  EXPECT_EQ(
      parse_quantized_mesh(by_hand() + extension(4, raw<std::uint32_t>({1}) + "{}"), "a").trailing_bytes, 1u);
  EXPECT_EQ(parse_quantized_mesh(by_hand() + extension(1, "\x80"), "a").trailing_bytes, 1u);

  QuantizedMesh plain = parse_quantized_mesh(by_hand(), "a");
  EXPECT_EQ(encode_quantized_mesh(plain), by_hand());
}

void expect_same(const QuantizedMesh& a, const QuantizedMesh& b) {
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.min_height_m, b.min_height_m);
  EXPECT_EQ(a.max_height_m, b.max_height_m);
  EXPECT_EQ(a.sphere_center, b.sphere_center);
  EXPECT_EQ(a.sphere_radius_m, b.sphere_radius_m);
  EXPECT_EQ(a.horizon_occlusion, b.horizon_occlusion);
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.water_mask, b.water_mask);
  EXPECT_EQ(a.metadata, b.metadata);
}

TEST(QuantizedMesh, RoundTripsWithIndicesOfBothWidths) {
  for (const int n :
       {1, 8, 254, 255, 256}) {  // 255: 65536 vertices, the last of two bytes; 256: an odd number
    QuantizedMesh tile = test::regular_tile({}, kPlace, n, test::hills_m, true);
    tile.metadata = R"({"a":1})";
    tile.water_mask = std::string(1, '\0');
    const std::string bytes = encode_quantized_mesh(tile);
    const std::size_t vertices = tile.vertices(), width = vertices > 65536 ? 4 : 2;
    const std::size_t padding = width == 4 && vertices % 2 == 1 ? 2 : 0;
    EXPECT_EQ(bytes.size(), 92 + 6 * vertices + padding + 4 + 3 * width * tile.triangles.size() + 16 +
                                width * 4 * static_cast<std::size_t>(n + 1) + 5 + 2 * vertices + 6 + 9 + 7);
    const QuantizedMesh again = parse_quantized_mesh(bytes, "a.terrain");
    expect_same(tile, again);
    EXPECT_EQ(again.trailing_bytes, 0u);
    ASSERT_EQ(again.normals.size(), vertices);
    for (std::size_t k = 0; k < vertices; k += 97) EXPECT_GT(dot(again.normals[k], tile.normals[k]), 0.9998);
    EXPECT_EQ(encode_quantized_mesh(again), bytes);
  }
}

TEST(QuantizedMesh, NormalsOfEveryCodeAreUnitAndComeBack) {
  QuantizedMesh tile = test::regular_tile({}, kPlace, 255, test::hills_m);
  ASSERT_EQ(tile.vertices(), 65536u);
  std::string codes;
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) codes += {static_cast<char>(a), static_cast<char>(b)};
  }
  const std::string plain = encode_quantized_mesh(tile);
  const QuantizedMesh read = parse_quantized_mesh(plain + extension(1, codes), "a");
  ASSERT_EQ(read.normals.size(), 65536u);
  for (const Vec3& normal : read.normals) EXPECT_NEAR(length(normal), 1, 1e-15);
  const QuantizedMesh again = parse_quantized_mesh(encode_quantized_mesh(read), "a");
  // Directions come back within what dividing by the length rounds; on the fold two codes name one.
  for (std::size_t k = 0; k < read.normals.size(); ++k)
    EXPECT_LT(length(read.normals[k] - again.normals[k]), 1e-14) << k;
}

TEST(QuantizedMesh, KeepsWhatIsWrongButCanBeDecoded) {
  std::string bytes = by_hand();
  const std::size_t indices = 92 + 24 + 4;
  bytes.replace(indices, 2, raw<std::uint16_t>({7}));
  EXPECT_EQ(parse_quantized_mesh(bytes, "a").triangles[0][0], 0xfffffff9u) << "0 − 7";
  bytes = by_hand();
  bytes.replace(92, 8, raw<std::uint16_t>({65534, 65534, 65535, 1}));
  EXPECT_THAT(parse_quantized_mesh(bytes, "a").u, ElementsAre(32767, 65534, 32766, 32765));
  std::string steep = header() + raw<std::uint32_t>({70000});
  for (int k = 0; k < 70000; ++k) steep += raw<std::uint16_t>({65534});
  steep += std::string(70000 * 4, '\0') + std::string(4 + 16, '\0');
  EXPECT_EQ(parse_quantized_mesh(steep, "a").u.back(), 2147483647) << "the sum passes 32 bits";
}

TEST(QuantizedMesh, ReadsGzippedTiles) {
  const QuantizedMesh tile = test::regular_tile({}, kPlace, 16, test::hills_m);
  const std::string bytes = encode_quantized_mesh(tile), packed = test::gzipped(bytes);
  ASSERT_TRUE(is_gzip(packed));
  ASSERT_FALSE(is_gzip(bytes));
  expect_same(tile, parse_quantized_mesh(packed, "a.terrain"));
  EXPECT_EQ(parse_quantized_mesh(packed + "tail", "a.terrain").trailing_bytes, 4u);
  const test::TemporaryFolder folder;
  expect_same(tile, read_quantized_mesh(folder.write("a.terrain", packed)));
  for (std::size_t cut = 4; cut < packed.size(); cut += 7)
    EXPECT_THAT(input_error([&] { parse_quantized_mesh(packed.substr(0, cut), "a.terrain"); }),
                AllOf(HasSubstr("a.terrain: gzip data, byte "), HasSubstr("cut short")));
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
  EXPECT_THAT(input_error([&] { parse_quantized_mesh(damaged, "a.terrain"); }), HasSubstr("gzip data, byte"));
}

TEST(QuantizedMesh, InflatesNoBombs) {
  const std::string bomb = test::gzipped(std::string(std::size_t{16} << 20U, '\0'));
  ASSERT_LT(bomb.size() * kMostInflation, std::size_t{16} << 20U);
  EXPECT_THAT(input_error([&] { gunzip(bomb, "a.terrain"); }), HasSubstr("bytes come out of"));
  EXPECT_EQ(gunzip(test::gzipped(std::string(kFreeInflated, '\0')), "a").bytes.size(), kFreeInflated);
}

TEST(QuantizedMesh, EveryCutIsATileOrAClearLine) {
  std::string bytes = by_hand();
  const std::size_t needed = bytes.size();
  bytes += extension(1, std::string(8, '\x80')) + extension(4, raw<std::uint32_t>({2}) + "{}");
  std::size_t whole = 0;
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    try {
      parse_quantized_mesh(std::string_view(bytes).substr(0, cut), "a.terrain");
      ++whole;
      EXPECT_GE(cut, needed);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("a.terrain: byte "), HasSubstr("cut short")));
    }
  }
  EXPECT_EQ(whole, 2u * 5u) << "behind the edges, and behind each extension's end, up to four bytes";
}

TEST(QuantizedMesh, EveryDamagedByteIsATileOrAClearLine) {
  const std::string bytes = by_hand() + extension(1, std::string(8, '\x80'));
  std::size_t read = 0, refused = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    for (const char value : {'\0', '\x01', '\x7f', '\xff'}) {
      std::string damaged = bytes;
      damaged[k] = value;
      try {
        const QuantizedMesh tile = parse_quantized_mesh(damaged, "a.terrain");
        EXPECT_LE(6 * tile.vertices() + 6 * tile.triangles.size(), bytes.size());
        ++read;
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(read, refused);
  EXPECT_GT(refused, 20u);
}

TEST(QuantizedMesh, RefusesCountsThatTheBytesDoNotHold) {
  const auto said = [](std::string bytes) {
    return input_error([&] { parse_quantized_mesh(bytes, "a.terrain"); });
  };
  const std::string many = raw<std::uint32_t>({0xffffffff}), four = raw<std::uint32_t>({4});
  EXPECT_THAT(said(""), HasSubstr("byte 0: the header's center takes 1 × 8 bytes, 0 are left"));
  EXPECT_THAT(said(header() + many + "abc"),
              HasSubstr("byte 92: the list of u takes 4294967295 × 2 bytes, 3 are left"));
  EXPECT_THAT(said(header() + four + std::string(24, '\0') + many),
              HasSubstr("byte 120: the list of triangles takes 4294967295 × 6 bytes, 0 are left"));
  EXPECT_THAT(said(header() + four + std::string(28, '\0') + many),
              HasSubstr("byte 124: the list of vertices of the west edge takes 4294967295 × 2"));
  EXPECT_THAT(said(by_hand() + "\x02" + many),
              HasSubstr("extension 2 takes 4294967295 × 1 bytes, 0 are left"));
  EXPECT_THAT(said(by_hand() + extension(4, many + "{}")),
              HasSubstr("metadata of 4294967295 bytes in an extension of 6"));
  EXPECT_THAT(said(by_hand() + extension(4, "{}")), HasSubstr("the metadata's length takes"));
  EXPECT_THAT(said(std::string(65 * 65 * 2 + 2, '\0')), HasSubstr("heightmap-1.0"));
  EXPECT_THAT(input_error([] { read_quantized_mesh("/no/such.terrain"); }),
              HasSubstr("cannot read /no/such.terrain"));
  EXPECT_THAT(input_error([] { read_quantized_mesh("/"); }), HasSubstr("is a folder, not a terrain tile"));
  EXPECT_THAT(input_error([] { read_quantized_mesh("/dev/zero"); }), HasSubstr("is a device"));
}

// Some sound tiles are as long as one of heightmap-1.0.
TEST(QuantizedMesh, IsKnownByWhatItIsNotByItsLength) {
  for (const std::size_t size : {std::size_t{8452}, std::size_t{73987}}) {
    std::string tile = by_hand();
    tile += extension(9, std::string(size - tile.size() - 5, 'x'));
    ASSERT_EQ(tile.size(), size);
    EXPECT_EQ(parse_quantized_mesh(tile, "a").triangles.size(), 2u);
    EXPECT_THAT(input_error([&] { parse_quantized_mesh(std::string(size, '\x5a'), "a.terrain"); }),
                HasSubstr("heightmap-1.0"));
  }
}

TEST(QuantizedMesh, EncodesNothingThatTheFormatCannotSay) {
  const QuantizedMesh tile = parse_quantized_mesh(by_hand(), "a");
  QuantizedMesh bad = tile;
  bad.u[1] = 32768;
  EXPECT_THROW(encode_quantized_mesh(bad), std::invalid_argument);
  bad = tile;
  bad.v.pop_back();
  EXPECT_THROW(encode_quantized_mesh(bad), std::invalid_argument);
  bad = tile;
  std::swap(bad.triangles[0], bad.triangles[1]);
  EXPECT_THROW(encode_quantized_mesh(bad), std::invalid_argument) << "no high-water order";
  const QuantizedMesh ordered = in_high_water_order(bad);
  EXPECT_EQ(parse_quantized_mesh(encode_quantized_mesh(ordered), "a").triangles, ordered.triangles);
  EXPECT_THAT(ordered.u, ElementsAre(0, 32767, 0, 32767));
  EXPECT_THAT(ordered.edges[2], ElementsAre(3, 1));
}

}  // namespace
}  // namespace plumbline
