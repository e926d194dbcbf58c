# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D FOLDER=… -D OUT=….cpp -P embed_shapes.cmake: writes the .off files of a folder as texts into a C++ source
# file, so that the program contains its library of shapes and needs no files for it.
file(GLOB files LIST_DIRECTORIES false ${FOLDER}/*.off)
list(SORT files)
set(texts "")
foreach(file ${files})
  get_filename_component(stem ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND texts "    {\"${stem}\", R\"off(${text})off\"},\n")
endforeach()
file(WRITE ${OUT} "#include \"host/shapes/files/shipped_shapes.hpp\"\n
namespace macadam {\nconst std::vector<ShippedShape>& shipped_shapes() {\n  static const std::vector<ShippedShape> texts{\n${texts}  };\n  return texts;\n}\n}  // namespace macadam\n")
