// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/mesh_file/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/little_endian.h"
#include "scenarios/whole_file.h"

namespace plumbline::mesh_file {
namespace {

std::size_t size_of(std::uint64_t component) {
  if (component == 5120 || component == 5121) return 1;
  if (component == 5122 || component == 5123) return 2;
  return component == 5125 || component == 5126 ? 4 : 0;
}

int hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

double GltfDocument::Accessor::value(std::size_t k, unsigned c) const {
  const std::size_t offset = k * stride + c * size_of(component);
  // Specification 3.11: how whole numbers stand for [-1, 1] and [0, 1].
  switch (component) {
    case 5120: {
      const double x = value_at<std::int8_t>(bytes, offset);
      return normalized ? std::max(x / 127, -1.0) : x;
    }
    case 5121: {
      const double x = value_at<std::uint8_t>(bytes, offset);
      return normalized ? x / 255 : x;
    }
    case 5122: {
      const double x = value_at<std::int16_t>(bytes, offset);
      return normalized ? std::max(x / 32767, -1.0) : x;
    }
    case 5123: {
      const double x = value_at<std::uint16_t>(bytes, offset);
      return normalized ? x / 65535 : x;
    }
    case 5125:
      return value_at<std::uint32_t>(bytes, offset);
    default:
      return static_cast<double>(value_at<float>(bytes, offset));
  }
}

GltfDocument::GltfDocument(std::string_view bytes, std::string_view name,
                           std::optional<std::filesystem::path> folder)
    : name_(name), folder_(std::move(folder)), bytes_read_(bytes.size()) {
  parse_container(bytes);
  const Json* asset = find(root_, "asset", "the file");
  const Json* version = asset == nullptr ? nullptr : find(*asset, "version", "asset");
  if (version == nullptr || !version->is_string() ||
      !version->get_ref<const std::string&>().starts_with("2."))
    fail("asset.version", "is not 2.x; glTF 2.0 is read here");
  if (const Json* required = find(root_, "extensionsRequired", "the file")) {
    if (!required->is_array()) fail("extensionsRequired", "is no list");
    for (const Json& extension : *required) {
      const std::string text = extension.is_string() ? extension.get<std::string>() : "?";
      // These change how a surface looks, not where it is; quantized positions are read.
      const bool harmless = text == "KHR_mesh_quantization" || text.starts_with("KHR_materials_") ||
                            text.starts_with("KHR_texture_") || text.starts_with("EXT_texture_") ||
                            text.starts_with("KHR_lights_");
      if (harmless) continue;
      const bool compressed =
          text.find("draco") != std::string::npos || text.find("meshopt") != std::string::npos;
      fail("extensionsRequired", fmt::format("{} is not read here; save the model without {}", text,
                                             compressed ? "compression" : "it"));
    }
  }
}

void GltfDocument::parse_container(std::string_view bytes) {
  std::string_view text = bytes;
  if (bytes.starts_with("glTF")) {
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if (bytes.size() < 12) fail("the header", "is cut short");
    if (const auto version = value_at<std::uint32_t>(bytes, 4); version != 2)
      fail("the header", fmt::format("names version {} of the container; 2 is read here", version));
    const std::size_t length = value_at<std::uint32_t>(bytes, 8);
    if (length < 12 || length > bytes.size())
      fail("the header",
           fmt::format("states {} bytes, the file has {}; it was cut short", length, bytes.size()));
    std::string_view rest = bytes.substr(12, length - 12);
    for (std::size_t k = 0; k == 0 || !rest.empty(); ++k) {
      if (rest.size() < 8) fail(fmt::format("chunk {}", k), "has no whole header; the file was cut short");
      const std::size_t size = value_at<std::uint32_t>(rest, 0);
      const auto type = value_at<std::uint32_t>(rest, 4);
      rest.remove_prefix(8);
      if (size > rest.size())
        fail(fmt::format("chunk {}", k),
             fmt::format("states {} bytes, {} are left; the file was cut short", size, rest.size()));
      if (k == 0) {
        if (type != kJson) fail("chunk 0", "is not the JSON that must come first");
        text = rest.substr(0, size);
      } else if (type == kBinary && !chunk_) {
        chunk_ = rest.substr(0, size);
      }
      rest.remove_prefix(size);
    }
  }
  try {
    root_ = Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    fail("the JSON", fmt::format("has a syntax error at byte {}", error.byte));
  } catch (const Json::exception&) {
    fail("the JSON", "holds a number out of range");
  }
}

void GltfDocument::fail(std::string_view place, std::string_view what) const {
  throw InputError(fmt::format("{}: {}: {}", one_line(name_), one_line(place), one_line(what)));
}

const GltfDocument::Json* GltfDocument::find(const Json& object, const char* key,
                                             std::string_view place) const {
  if (!object.is_object()) fail(place, "is no JSON object");
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::uint64_t GltfDocument::whole(const Json& value, std::string_view place) const {
  constexpr double kMost = 9007199254740992.0;  // 2^53: whole numbers of JSON's doubles end here
  const double number = value.is_number() ? value.get<double>() : -1;
  if (!(number >= 0 && number <= kMost) || std::floor(number) != number)
    // Printing a nest of lists would take the stack that reading it did not.
    fail(place,
         fmt::format("{} is not a whole number",
                     value.is_structured() ? value.type_name() : one_line(value.dump(-1, ' ', true), 40)));
  return static_cast<std::uint64_t>(number);
}

std::uint64_t GltfDocument::whole_or(const Json& object, const char* key, std::uint64_t otherwise,
                                     std::string_view place) const {
  const Json* value = find(object, key, place);
  return value == nullptr ? otherwise : whole(*value, fmt::format("{}.{}", place, key));
}

double GltfDocument::number(const Json& value, std::string_view place) const {
  if (!value.is_number()) fail(place, "is not a number");
  return value.get<double>();
}

std::size_t GltfDocument::count(const char* array) const {
  const Json* list = find(root_, array, "the file");
  if (list == nullptr) return 0;
  if (!list->is_array()) fail(array, "is no list");
  return list->size();
}

const GltfDocument::Json& GltfDocument::element(const char* array, std::uint64_t index,
                                                std::string_view named_by) const {
  const std::size_t size = count(array);
  if (index >= size) fail(named_by, fmt::format("names {}[{}], of {}", array, index, size));
  return root_.at(array)[static_cast<std::size_t>(index)];
}

std::string GltfDocument::decoded(std::string_view base64, std::string_view place) const {
  while (!base64.empty() && base64.back() == '=') base64.remove_suffix(1);
  std::string out;
  out.reserve(base64.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int have = 0;
  for (const char c : base64) {
    std::uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      digit = static_cast<std::uint32_t>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint32_t>(c - '0') + 52;
    } else if (c == '+' || c == '/') {
      digit = c == '+' ? 62 : 63;
    } else {
      fail(place, "holds a character that is not base64");
    }
    bits = (bits << 6 | digit) & 0xffffff;
    have += 6;
    if (have >= 8) {
      have -= 8;
      out.push_back(static_cast<char>(bits >> have & 0xff));
    }
  }
  return out;
}

std::string GltfDocument::relative_file(std::string_view uri, std::string_view place) const {
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    if (uri[k] == '%' && k + 2 < uri.size() && hex(uri[k + 1]) >= 0 && hex(uri[k + 2]) >= 0) {
      path.push_back(static_cast<char>(hex(uri[k + 1]) * 16 + hex(uri[k + 2])));
      k += 2;
    } else {
      path.push_back(uri[k]);
    }
  }
  const std::filesystem::path relative(path);
  const bool leaves =
      std::any_of(relative.begin(), relative.end(), [](const auto& part) { return part == ".."; });
  if (path.empty() || path.find_first_of(std::string_view(":\\\0", 3)) != std::string::npos ||
      relative.is_absolute() || leaves)
    fail(place,
         fmt::format("'{}' is not a file beside the model or below; move it there", one_line(uri, 80)));
  if (!folder_)
    fail(place, fmt::format("'{}' is a file of its own, and only bytes were given", one_line(uri, 80)));
  const std::filesystem::path file = *folder_ / relative;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    fail(place, fmt::format("'{}' is missing beside the model", one_line(uri, 80)));
  try {
    return read_whole_file(file, "a buffer");
  } catch (const InputError&) {
    fail(place, fmt::format("'{}' cannot be read", one_line(uri, 80)));
  }
}

std::string_view GltfDocument::buffer(std::uint64_t index, std::string_view named_by) {
  if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
  const std::string place = fmt::format("buffers[{}]", index);
  const Json& entry = element("buffers", index, named_by);
  std::string_view bytes;
  if (const Json* uri = find(entry, "uri", place)) {
    if (!uri->is_string()) fail(place + ".uri", "is no text");
    const std::string_view text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:")) {
      constexpr std::string_view kMark = ";base64,";
      const auto mark = text.find(kMark);
      if (mark == std::string_view::npos) fail(place + ".uri", "holds data that are not base64");
      owned_.push_back(decoded(text.substr(mark + kMark.size()), place + ".uri"));
    } else {
      owned_.push_back(relative_file(text, place + ".uri"));
      bytes_read_ += owned_.back().size();
    }
    bytes = owned_.back();
  } else {
    if (index != 0 || !chunk_)
      fail(place, "has neither uri nor binary chunk; it may belong to a compression that is not read here");
    bytes = *chunk_;
  }
  const Json* stated = find(entry, "byteLength", place);
  if (stated == nullptr) fail(place, "has no byteLength");
  const std::uint64_t length = whole(*stated, place + ".byteLength");
  if (length > bytes.size())
    fail(place, fmt::format("states {} bytes, and has {}; it was cut short", length, bytes.size()));
  bytes = bytes.substr(0, static_cast<std::size_t>(length));
  buffers_.emplace(index, bytes);
  return bytes;
}

GltfDocument::Accessor GltfDocument::accessor(std::uint64_t index, std::string_view named_by) {
  Accessor out;
  out.place = fmt::format("accessors[{}]", index);
  const Json& entry = element("accessors", index, named_by);
  if (find(entry, "sparse", out.place) != nullptr)
    fail(out.place, "is sparse, which is not read here; save the model without sparse accessors");
  const Json* type = find(entry, "type", out.place);
  out.components = type == nullptr ? 0 : *type == "SCALAR" ? 1 : *type == "VEC3" ? 3 : 0;
  if (out.components == 0) fail(out.place, "is neither SCALAR nor VEC3");
  out.component = whole_or(entry, "componentType", 0, out.place);
  const std::size_t element_size = size_of(out.component) * out.components;
  if (element_size == 0) fail(out.place, fmt::format("has unknown componentType {}", out.component));
  if (const Json* normalized = find(entry, "normalized", out.place)) {
    if (!normalized->is_boolean()) fail(out.place + ".normalized", "is neither true nor false");
    out.normalized = normalized->get<bool>();
  }
  if (find(entry, "bufferView", out.place) == nullptr)
    fail(out.place, "has no bufferView: zeros only, or a compression that is not read here");
  const std::uint64_t view_index = whole_or(entry, "bufferView", 0, out.place);
  const std::string view_place = fmt::format("bufferViews[{}]", view_index);
  const Json& view = element("bufferViews", view_index, out.place);
  if (find(view, "buffer", view_place) == nullptr || find(view, "byteLength", view_place) == nullptr)
    fail(view_place, "lacks buffer or byteLength");
  const std::string_view bytes = buffer(whole_or(view, "buffer", 0, view_place), view_place);
  // Each is at most 2^53: their sums do not overflow.
  const std::uint64_t view_offset = whole_or(view, "byteOffset", 0, view_place);
  const std::uint64_t view_length = whole_or(view, "byteLength", 0, view_place);
  if (view_offset + view_length > bytes.size())
    fail(view_place,
         fmt::format("ends at byte {} of a buffer of {}", view_offset + view_length, bytes.size()));
  const std::uint64_t stride = whole_or(view, "byteStride", element_size, view_place);
  constexpr std::uint64_t kGreatestStride = 252;  // specification 3.6.2.4
  if (stride < element_size || stride > kGreatestStride)
    fail(view_place,
         fmt::format("byteStride {} is not inside [{}, {}]", stride, element_size, kGreatestStride));
  const std::uint64_t offset = whole_or(entry, "byteOffset", 0, out.place);
  const std::uint64_t count = whole_or(entry, "count", 0, out.place);
  // count first: below the view's length its product with the stride does not overflow.
  if (count > view_length || (count > 0 && offset + (count - 1) * stride + element_size > view_length))
    fail(out.place, fmt::format("{} elements from byte {} do not fit into {} of {} bytes", count, offset,
                                view_place, view_length));
  out.bytes = bytes.substr(static_cast<std::size_t>(view_offset), static_cast<std::size_t>(view_length));
  if (count > 0) out.bytes.remove_prefix(static_cast<std::size_t>(offset));
  out.count = static_cast<std::size_t>(count);
  out.stride = static_cast<std::size_t>(stride);
  return out;
}

}  // namespace plumbline::mesh_file
