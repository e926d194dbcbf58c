// SPDX-License-Identifier: GPL-3.0-or-later
/// \file files.hpp  Result files that survive a failed run.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "macadam/contact_network.hpp"

namespace macadam {

/// Replaces a file by a rename, so that a reader finds the old bytes or the new; what could not be written whole is
/// removed. `to_disk`: waits until it is there, so that a power failure leaves one of the two as well. \throws
/// RunError.
void write_whole(const std::filesystem::path& file, std::string_view bytes, bool to_disk = false);

/// A name as a field of a CSV file: quoted where it has to be (RFC 4180).
std::string csv_field(const std::string& name);

/// A table that grows as a run goes on: every line is flushed as it is measured.
class LineWriter {
 public:
  /// Begins anew; `head`: its first lines. \throws RunError when the file cannot be opened.
  LineWriter(const std::filesystem::path& file, std::string_view head);
  /// A line without its end. \throws RunError when the disk refuses.
  void add(std::string_view line);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

/// contacts.csv: `a,b,pair,area,distance,nx,ny,nz,points`, in the network's order. \throws RunError.
void write_contacts_csv(const std::filesystem::path& file, const ContactNetwork& network);

}  // namespace macadam
