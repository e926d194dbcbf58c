// SPDX-License-Identifier: GPL-3.0-or-later
// forged_hdf5.cpp  Makes an HDF5 file from a recipe, which is a sequence of random bytes. Each byte decides one
// property of the file. After the end of the recipe every decision is 0.
#include "tests/fuzz/forged_hdf5.hpp"

#include <H5Cpp.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace macadam::fuzz {
namespace {

class Recipe {
 public:
  explicit Recipe(std::string_view bytes) : rest_(bytes) {}
  std::size_t below(std::size_t end) {
    if (rest_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte % end;
  }
  template <class List>
  const auto& one_of(const List& list) {
    return list[below(std::size(list))];
  }
  bool more() const { return !rest_.empty(); }

 private:
  std::string_view rest_;
};

H5::DataType type_by(Recipe& recipe) {
  using P = H5::PredType;
  static const H5::DataType plain[] = {P::NATIVE_DOUBLE,  P::NATIVE_FLOAT, P::NATIVE_INT64,  P::NATIVE_UINT16,
                                       P::NATIVE_UINT8,   P::NATIVE_INT32, P::STD_I64BE,     P::IEEE_F64BE,
                                       P::NATIVE_LDOUBLE, P::NATIVE_B8,    P::NATIVE_OPAQUE, P::STD_REF_OBJ};
  static const std::size_t lengths[] = {1, 2, 4, 100, 60000, std::size_t{1} << 31};
  const std::size_t kind = recipe.below(2 * std::size(plain));
  if (kind < std::size(plain)) return plain[kind];
  switch (kind % 6) {
    case 0:
      return H5::StrType(P::C_S1, H5T_VARIABLE);
    case 1: {
      H5::CompType both(std::size_t{16});
      both.insertMember("a", 0, P::NATIVE_DOUBLE), both.insertMember("b", 8, P::NATIVE_INT64);
      return both;
    }
    case 2:
      return H5::VarLenType(P::NATIVE_DOUBLE);
    case 3: {
      const hsize_t three = 3;
      return H5::ArrayType(P::NATIVE_FLOAT, 1, &three);
    }
    default:
      return H5::StrType(P::C_S1, recipe.one_of(lengths));
  }
}

H5::DataSpace space_by(Recipe& recipe, std::size_t rank) {
  static const hsize_t counts[] = {1, 2, 3, 4, 0, 7, 100, 1 << 20, hsize_t{1} << 31, hsize_t{1} << 40};
  if (rank == 5) return H5::DataSpace(H5S_NULL);
  hsize_t size[4];
  std::generate_n(size, rank, [&] { return recipe.one_of(counts); });
  return rank == 0 ? H5::DataSpace(H5S_SCALAR) : H5::DataSpace(static_cast<int>(rank), size);
}

/// Writes zeros to a dataset or an attribute if it has few values and they are not pointers.
template <class Values>
void fill(const Values& values, const H5::DataType& type) {
  const double bytes =
      static_cast<double>(values.getSpace().getSimpleExtentNpoints()) * static_cast<double>(type.getSize());
  if (!(bytes > 0 && bytes < 1e4) || type.getClass() == H5T_VLEN || H5Tis_variable_str(type.getId()) > 0) return;
  const std::string zeros(static_cast<std::size_t>(bytes), '\0');
  if constexpr (std::is_same_v<Values, H5::Attribute>)
    values.write(type, zeros.data());
  else
    values.write(zeros.data(), type);
}

void add_attribute(const H5::DataSet& set, const std::string& name, Recipe& recipe) {
  static const std::size_t ranks[] = {0, 1, 2, 5};
  const H5::DataType type = type_by(recipe);
  fill(set.createAttribute(name, type, space_by(recipe, recipe.one_of(ranks))), type);
}

void add_dataset(const H5::Group& group, const std::string& name, Recipe& recipe,
                 const std::vector<std::string>& attributes) {
  const std::size_t rank = recipe.below(6);
  const H5::DataType type = type_by(recipe);
  H5::DSetCreatPropList how;
  const std::size_t layout = recipe.below(6);
  if (layout == 1) how.setLayout(H5D_COMPACT);
  if (layout == 2) how.setExternal("/etc/hostname", 0, H5F_UNLIMITED);
  if (layout > 3 && rank > 0 && rank < 5) {
    static const hsize_t edges[] = {1, 2, 8, 1 << 10};
    hsize_t chunk[4];
    std::generate_n(chunk, rank, [&] { return recipe.one_of(edges); });
    how.setChunk(static_cast<int>(rank), chunk);
    if (layout == 5) how.setDeflate(9);
  }
  const H5::DataSet set = group.createDataSet(name, type, space_by(recipe, rank), how);
  if (layout != 2 && recipe.below(2) == 0) fill(set, type);
  for (std::size_t more = recipe.below(3); more > 0; --more) add_attribute(set, recipe.one_of(attributes), recipe);
}

void add(const H5::H5File& file, Recipe& recipe, const std::vector<std::string>& groups,
         const std::vector<std::string>& names, const std::vector<std::string>& attributes) {
  const H5::Group group = file.openGroup(recipe.one_of(groups));
  const std::string &name = recipe.one_of(names), &other = recipe.one_of(names);
  switch (recipe.below(10)) {
    case 0:
      group.createGroup(name);
      break;
    case 1:
      H5Lcreate_soft(other.c_str(), group.getId(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 2:
      H5Lcreate_hard(group.getId(), other.c_str(), group.getId(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 3:
      H5Lcreate_external("/dev/null", "/", group.getId(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    default:
      add_dataset(group, name, recipe, attributes);
  }
}

}  // namespace

std::string forged_hdf5(std::string_view bytes, const std::vector<std::string>& groups,
                        const std::vector<std::string>& names, const std::vector<std::string>& attributes) {
  Recipe recipe(bytes);
  H5::Exception::dontPrint();
  H5::FileAccPropList access;
  access.setCore(1 << 16, false);
  const H5::H5File file("forged", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access);
  for (const std::string& group : groups)
    if (group != "/" && recipe.below(50) != 49) file.createGroup(group);
  for (int entries = 0; recipe.more() && entries < 20; ++entries) {
    try {
      add(file, recipe, groups, names, attributes);
    } catch (const H5::Exception&) {  // HDF5 could not make this entry, so no reader has to read it
    }
  }
  file.flush(H5F_SCOPE_GLOBAL);
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(0, H5Fget_file_image(file.getId(), nullptr, 0))), '\0');
  H5Fget_file_image(file.getId(), image.data(), image.size());
  return image;
}

}  // namespace macadam::fuzz
