// SPDX-License-Identifier: GPL-3.0-or-later
/// \file hdf5_type.hpp  HDF5's names of this machine's number types.
#pragma once

#include <H5Cpp.h>

#include <cstdint>

namespace macadam {

inline const H5::PredType& type_of(float) { return H5::PredType::NATIVE_FLOAT; }
inline const H5::PredType& type_of(double) { return H5::PredType::NATIVE_DOUBLE; }
inline const H5::PredType& type_of(std::int32_t) { return H5::PredType::NATIVE_INT32; }
inline const H5::PredType& type_of(std::int64_t) { return H5::PredType::NATIVE_INT64; }

}  // namespace macadam
