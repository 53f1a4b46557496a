// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace plumbline::mesh_file {

/// A glTF 2.0 file's JSON with its buffers (glTF 2.0 specification, sections 3.6 and 4.4). Every look-up
/// checks what it finds and throws InputError, naming the place as the specification writes it
/// ("accessors[3]").
class GltfDocument {
 public:
  using Json = nlohmann::json;

  /// A run of vectors or scalars inside a buffer: all of it lies inside.
  struct Accessor {
    std::string_view bytes;
    std::size_t count = 0, stride = 0;
    unsigned components = 0;      ///< 1 for SCALAR, 3 for VEC3
    std::uint64_t component = 0;  ///< 5120 i8, 5121 u8, 5122 i16, 5123 u16, 5125 u32, 5126 f32
    bool normalized = false;
    std::string place;

    /// Component c of element k, normalised if the accessor says so. Requires: both in range.
    [[nodiscard]] double value(std::size_t k, unsigned c) const;
  };

  /// `folder`: where relative buffers lie; none: they are refused. `bytes` must outlive the document.
  GltfDocument(std::string_view bytes, std::string_view name, std::optional<std::filesystem::path> folder);

  [[noreturn]] void fail(std::string_view place, std::string_view what) const;
  [[nodiscard]] const Json& root() const { return root_; }
  /// Member `key` of an object; null if there is none. Fails if `object` is none.
  const Json* find(const Json& object, const char* key, std::string_view place) const;
  /// A whole number of [0, 2^53].
  [[nodiscard]] std::uint64_t whole(const Json& value, std::string_view place) const;
  std::uint64_t whole_or(const Json& object, const char* key, std::uint64_t otherwise,
                         std::string_view place) const;
  [[nodiscard]] double number(const Json& value, std::string_view place) const;
  /// Elements of a top-level array; 0 if there is none.
  std::size_t count(const char* array) const;
  /// Element `index` of a top-level array.
  const Json& element(const char* array, std::uint64_t index, std::string_view named_by) const;

  Accessor accessor(std::uint64_t index, std::string_view named_by);
  /// Bytes of the file and of the buffers read so far: what bounds the memory that a scene may take.
  [[nodiscard]] std::size_t bytes_read() const { return bytes_read_; }

 private:
  void parse_container(std::string_view bytes);
  std::string_view buffer(std::uint64_t index, std::string_view named_by);
  std::string decoded(std::string_view base64, std::string_view place) const;
  std::string relative_file(std::string_view uri, std::string_view place) const;

  std::string name_;
  std::optional<std::filesystem::path> folder_;
  Json root_;
  std::optional<std::string_view> chunk_;  // GLB's binary chunk
  std::deque<std::string> owned_;          // decoded and separate buffers: they do not move
  std::map<std::uint64_t, std::string_view> buffers_;
  std::size_t bytes_read_ = 0;
};

}  // namespace plumbline::mesh_file
