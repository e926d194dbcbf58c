// SPDX-License-Identifier: GPL-3.0-or-later
/// \file hdf5_numbers.hpp  Reads arrays and attributes of an HDF5 file in tests.
#pragma once

#include <H5Cpp.h>

#include <filesystem>
#include <string>
#include <vector>

namespace macadam::test {

inline H5::H5File open_hdf5(const std::filesystem::path& file) {
  H5::Exception::dontPrint();
  H5::FileAccPropList unlocked;
  H5Pset_file_locking(unlocked.getId(), false, true);
  return H5::H5File(file.string(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, unlocked);
}

/// Returns all numbers of an array.
inline std::vector<double> numbers(const H5::H5File& file, const std::string& name) {
  const H5::DataSet set = file.openDataSet(name);
  std::vector<double> out(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
  if (!out.empty()) set.read(out.data(), H5::PredType::NATIVE_DOUBLE);
  return out;
}

/// Returns `number` rows of an array from row `first` on, as a viewer reads one frame.
inline std::vector<double> rows(const H5::H5File& file, const std::string& name, hsize_t first, hsize_t number) {
  const H5::DataSet set = file.openDataSet(name);
  H5::DataSpace space = set.getSpace();
  std::vector<hsize_t> size(static_cast<std::size_t>(space.getSimpleExtentNdims())), start(size.size(), 0);
  space.getSimpleExtentDims(size.data());
  start[0] = first, size[0] = number;
  space.selectHyperslab(H5S_SELECT_SET, size.data(), start.data());
  hsize_t all = 1;
  for (const hsize_t n : size) all *= n;
  std::vector<double> out(all);
  set.read(out.data(), H5::PredType::NATIVE_DOUBLE, H5::DataSpace(static_cast<int>(size.size()), size.data()), space);
  return out;
}

/// Returns the dimensions of an array: the number of rows, then the numbers per row if there are several.
inline std::vector<hsize_t> shape(const H5::H5File& file, const std::string& name) {
  const H5::DataSpace space = file.openDataSet(name).getSpace();
  std::vector<hsize_t> out(static_cast<std::size_t>(space.getSimpleExtentNdims()));
  space.getSimpleExtentDims(out.data());
  return out;
}

inline std::string text(const H5::H5Object& object, const std::string& attribute) {
  const H5::Attribute a = object.openAttribute(attribute);
  std::string out;
  a.read(a.getStrType(), out);
  return out;
}

inline std::int64_t steps(const H5::H5File& file) {
  std::int64_t out = -1;
  file.openGroup("VTKHDF/Steps").openAttribute("NSteps").read(H5::PredType::NATIVE_INT64, &out);
  return out;
}

}  // namespace macadam::test
