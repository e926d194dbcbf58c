// SPDX-License-Identifier: GPL-3.0-or-later
// gzip.cpp  Compresses and unpacks texts with zlib, in the gzip format.
#include "tests/fuzz/gzip.hpp"

#include <zlib.h>

#include <cstdlib>

namespace macadam::fuzz {
namespace {

constexpr int with_gzip = 15 + 16;  // window of 2^15 bytes; adding 16 selects the gzip header

std::string stream_of(std::string_view text, int level) {
  z_stream z{};
  if (deflateInit2(&z, level, Z_DEFLATED, with_gzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) std::abort();
  std::string out(deflateBound(&z, text.size()), '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

}  // namespace

std::string unpacked(std::string_view bytes) {
  z_stream z{};
  if (inflateInit2(&z, with_gzip) != Z_OK) std::abort();
  std::string out(1 << 16, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  inflate(&z, Z_FINISH);
  out.resize(z.total_out);
  inflateEnd(&z);
  return out;
}

std::string packed(const std::string& text, Random& random) {
  const int level = static_cast<int>(below(random, 10));
  if (below(random, 8) > 0) return stream_of(text, level);
  const std::size_t cut = below(random, text.size() + 1);
  const std::string_view all = text;
  return stream_of(all.substr(0, cut), level) + stream_of(all.substr(cut), level);
}

std::string repeated(const std::string& text, Random& random) {
  const std::size_t begin = text.empty() ? 0 : below(random, text.size());
  const std::string piece = text.substr(begin, 1 + below(random, 60));
  std::string out = text.substr(0, begin);
  const std::size_t most = std::size_t{1} << (10 + below(random, 13));
  while (!piece.empty() && out.size() < most) out += piece;
  return out;
}

}  // namespace macadam::fuzz
