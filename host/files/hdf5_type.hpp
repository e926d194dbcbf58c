// SPDX-License-Identifier: GPL-3.0-or-later
/// \file hdf5_type.hpp  Returns HDF5's names for the number types of this machine.
#pragma once

#include <H5Cpp.h>

#include <cstdint>

namespace macadam {

/// Returns HDF5's native type for the type of the argument, whose value is ignored.
inline const H5::PredType& type_of(float) { return H5::PredType::NATIVE_FLOAT; }
inline const H5::PredType& type_of(double) { return H5::PredType::NATIVE_DOUBLE; }
inline const H5::PredType& type_of(std::int32_t) { return H5::PredType::NATIVE_INT32; }
inline const H5::PredType& type_of(std::int64_t) { return H5::PredType::NATIVE_INT64; }

}  // namespace macadam
