// SPDX-License-Identifier: GPL-3.0-or-later
/// \file header_lines.hpp  The lines of text that stand before the voxels of an image, or in a file of their own.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace macadam::ct {

/// Facts in the header of an image that ITK does not report.
struct HeaderFacts {
  std::filesystem::path voxels;  ///< the file that holds them
  std::optional<double> unit =
      1e-3;                        ///< of lengths [m]; millimetres where the file names none, empty if it is not known
  bool white_is_zero = false;      ///< the grey values have to be inverted
  std::vector<std::string> notes;  ///< for the user

  /// Takes the unit that a header names, or makes it unknown with a note.
  void take_unit(std::string_view name);
};

class HeaderLines {
 public:
  /// `what`: the header of which format, for messages.
  HeaderLines(const std::filesystem::path& file, std::string what);

  /// The next line without its end, or nothing behind the last. \throws InputError for one of 65,536 bytes or more, and
  /// for zero bytes and carriage returns within it, at which ITK ends lines or values and this class would not.
  std::optional<std::string> next();
  /// \throws InputError naming the line that was read last.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
  [[noreturn]] void refuse(std::string_view key, std::string_view value, const std::string& expected) const;
  /// The file beside the header that a line names. \throws InputError where it is not there, or is no file.
  std::filesystem::path beside(std::string_view key, std::string_view value) const;
  /// \throws InputError for a line that names no such file, but many, say.
  [[noreturn]] void refuse_voxels(std::string_view key, std::string_view value) const;

 private:
  std::filesystem::path file_;
  std::string what_, buffer_;
  std::ifstream in_;
  int number_ = 0;
};

/// Without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace macadam::ct
