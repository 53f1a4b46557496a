// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/gzip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <zlib.h>

#include "scenarios/error.h"

namespace plumbline {

bool is_gzip(std::string_view bytes) {
  constexpr unsigned kReservedFlags = 0xe0;
  return bytes.size() >= 4 && bytes.starts_with("\x1f\x8b\x08") &&
         (static_cast<unsigned char>(bytes[3]) & kReservedFlags) == 0;
}

Inflated gunzip(std::string_view bytes, std::string_view name) {
  const auto fail = [&](std::size_t at, std::string_view what) {
    throw InputError(fmt::format("{}: gzip data, byte {}: {}", one_line(name), at, what));
  };
  z_stream stream{};
  constexpr int kGzipOnly = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, &inflateEnd);
  const std::size_t most =
      std::min(kMostInflated, std::max(kFreeInflated, bytes.size() < kMostInflated / kMostInflation
                                                          ? bytes.size() * kMostInflation
                                                          : kMostInflated));
  Inflated out;
  std::array<Bytef, 1U << 16U> piece;  // NOLINT(*-member-init): zlib fills it
  std::size_t fed = 0;
  for (;;) {
    if (stream.avail_in == 0) {
      const std::size_t feed = std::min<std::size_t>(bytes.size() - fed, std::numeric_limits<uInt>::max());
      // zlib's interface of 1995 takes no const; it does not write there.
      stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data() + fed));
      stream.avail_in = static_cast<uInt>(feed);
      fed += feed;
    }
    stream.next_out = piece.data();
    stream.avail_out = piece.size();
    const int state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t at = fed - stream.avail_in;
    const std::size_t fresh = piece.size() - stream.avail_out;
    if (fresh > most - out.bytes.size())
      fail(at, fmt::format("more than {} bytes come out of {}; no terrain tile is packed so densely", most,
                           bytes.size()));
    out.bytes.append(reinterpret_cast<const char*>(piece.data()), fresh);
    if (state == Z_STREAM_END) {
      out.rest = bytes.size() - at;
      return out;
    }
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state == Z_BUF_ERROR || (state == Z_OK && stream.avail_in == 0 && fed == bytes.size() && fresh == 0))
      fail(at, "the data end before they are complete; the file was cut short");
    if (state != Z_OK)
      fail(at, fmt::format("damaged ({}); fetch the file again",
                           stream.msg == nullptr ? "no deflate" : stream.msg));
  }
}

}  // namespace plumbline
