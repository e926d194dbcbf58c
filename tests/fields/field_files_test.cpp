// SPDX-License-Identifier: GPL-3.0-or-later
// field_files_test.cpp  Tests field files in HDF5 and XML: they are complete after each frame, also after a kill or on
// a full disk.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include <fmt/format.h>

#include <atomic>
#include <random>

#include "tests/support/hdf5_numbers.hpp"
#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

using Floats = std::vector<float>;
using Whole = std::vector<std::int32_t>;

/// Returns n points in a row, as vertices or joined by lines.
FieldMesh row_of_points(int n, FieldMesh::Shape shape = FieldMesh::Shape::vertices) {
  FieldMesh out;
  out.shape = shape;
  const int reach = shape == FieldMesh::Shape::lines ? 2 : 1;
  out.offsets.push_back(0);
  Whole number;
  for (int i = 0; i < n; ++i) out.points.insert(out.points.end(), {static_cast<float>(i), 0.25F, -1.5F});
  for (int i = 0; i + reach <= n; ++i) {
    for (int k = 0; k < reach; ++k) out.connectivity.push_back(i + k);
    out.offsets.push_back(static_cast<std::int64_t>(out.connectivity.size()));
    number.push_back(7 * i);
  }
  out.arrays.push_back({"number", "1", 1, number});
  return out;
}

/// Returns arrays of a frame whose numbers depend on the time.
std::vector<FieldArray> arrays_at(std::size_t rows, double time) {
  Floats u(3 * rows), f(rows);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = static_cast<float>(1000 * time + static_cast<double>(i));
  for (std::size_t i = 0; i < rows; ++i) f[i] = static_cast<float>(-time);
  return {{"u", "m", 3, u}, {"f", "N", 1, f}};
}

class FieldFiles : public TestFolder {
 protected:
  fs::path stem() const { return folder_ / "row"; }
  fs::path vtkhdf() const { return folder_ / "row.vtkhdf"; }
  fs::path pvd() const { return folder_ / "row.pvd"; }

  std::unique_ptr<FieldSeries> begin(int points, FieldFormat format = FieldFormat::vtkhdf,
                                     std::optional<double> until = {}) const {
    return begin_fields(stem(), format, row_of_points(points), until);
  }
  /// Expects that the file has `frames` frames at times 0, 1, 2 …, each with its own numbers.
  void expect_frames(std::size_t frames, std::size_t points) const {
    const H5::H5File file = open_hdf5(vtkhdf());
    ASSERT_EQ(steps(file), static_cast<std::int64_t>(frames));
    for (std::size_t k = 0; k < frames; ++k) {
      const double time = static_cast<double>(k);
      EXPECT_EQ(rows(file, "VTKHDF/Steps/Values", k, 1).front(), time);
      const double begin = rows(file, "VTKHDF/Steps/PointDataOffsets/u", k, 1).front();
      EXPECT_EQ(begin, time * static_cast<double>(points));
      const auto u = rows(file, "VTKHDF/PointData/u", k * points, points);
      ASSERT_EQ(u.size(), 3 * points);
      EXPECT_EQ(u.front(), 1000 * time);
      EXPECT_EQ(u.back(), static_cast<float>(1000 * time + 3 * static_cast<double>(points) - 1));
      EXPECT_EQ(rows(file, "VTKHDF/PointData/f", k * points, points), std::vector<double>(points, -time));
    }
  }
};

/// A VTKHDF file has all groups and attributes that its specification requires.
TEST_F(FieldFiles, VtkHdfHasEveryGroupThatItsDocumentationAsksFor) {
  const auto series = begin_fields(stem(), FieldFormat::vtkhdf, row_of_points(4, FieldMesh::Shape::lines));
  EXPECT_FALSE(fs::exists(vtkhdf()));  // no file before the first frame, because viewers fail on empty ones
  series->add(0.5, arrays_at(3, 0.5));
  series->add(0.75, arrays_at(3, 0.75));
  EXPECT_EQ(series->size(), 2U);
  const H5::H5File file = open_hdf5(vtkhdf());  // while the series is still open for writing
  const H5::Group root = file.openGroup("VTKHDF");
  EXPECT_EQ(text(root, "Type"), "PolyData");
  std::int64_t version[2];
  root.openAttribute("Version").read(H5::PredType::NATIVE_INT64, version);
  EXPECT_EQ(version[0], 2);
  EXPECT_EQ(version[1], 0);
  using List = std::vector<double>;
  using Size = std::vector<hsize_t>;
  EXPECT_EQ(numbers(file, "VTKHDF/NumberOfPoints"), List{4});
  EXPECT_EQ(shape(file, "VTKHDF/Points"), (Size{4, 3}));
  EXPECT_EQ(numbers(file, "VTKHDF/Points"), (List{0, 0.25, -1.5, 1, 0.25, -1.5, 2, 0.25, -1.5, 3, 0.25, -1.5}));
  EXPECT_EQ(numbers(file, "VTKHDF/Lines/Connectivity"), (List{0, 1, 1, 2, 2, 3}));
  EXPECT_EQ(numbers(file, "VTKHDF/Lines/Offsets"), (List{0, 2, 4, 6}));
  EXPECT_EQ(numbers(file, "VTKHDF/Lines/NumberOfCells"), List{3});
  EXPECT_EQ(numbers(file, "VTKHDF/Lines/NumberOfConnectivityIds"), List{6});
  for (const std::string other : {"Vertices", "Polygons", "Strips"}) {
    EXPECT_EQ(numbers(file, "VTKHDF/" + other + "/NumberOfCells"), List{0});
    EXPECT_EQ(numbers(file, "VTKHDF/" + other + "/NumberOfConnectivityIds"), List{0});
    EXPECT_EQ(numbers(file, "VTKHDF/" + other + "/Connectivity"), List{});
    EXPECT_EQ(numbers(file, "VTKHDF/" + other + "/Offsets"), List{0});
  }
  EXPECT_EQ(steps(file), 2);
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/Values"), (List{0.5, 0.75}));
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/NumberOfParts"), (List{1, 1}));
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/PartOffsets"), (List{0, 0}));
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/PointOffsets"), (List{0, 0}));
  EXPECT_EQ(shape(file, "VTKHDF/Steps/CellOffsets"), (Size{2, 4}));
  EXPECT_EQ(shape(file, "VTKHDF/Steps/ConnectivityIdOffsets"), (Size{2, 4}));
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/CellDataOffsets/number"), (List{0, 0}));
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/CellDataOffsets/u"), (List{0, 3}));
  EXPECT_EQ(numbers(file, "VTKHDF/CellData/number"), (List{0, 7, 14}));
  EXPECT_EQ(shape(file, "VTKHDF/CellData/u"), (Size{6, 3}));
  EXPECT_EQ(numbers(file, "VTKHDF/CellData/f"), (List{-0.5, -0.5, -0.5, -0.75, -0.75, -0.75}));
  EXPECT_EQ(text(file.openDataSet("VTKHDF/CellData/u"), "unit"), "m");
  EXPECT_EQ(file.openDataSet("VTKHDF/CellData/u").getDataType().getSize(), sizeof(float));
}

/// An integer that a child process shares with its parent.
class Shared {
 public:
  Shared()
      : at_(static_cast<std::atomic<int>*>(
            mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  ~Shared() { munmap(at_, sizeof *at_); }
  std::atomic<int>& operator*() const { return *at_; }

 private:
  std::atomic<int>* at_;
};

/// A writer that is killed at a random moment leaves a valid file with at least the frames that were finished.
TEST_F(FieldFiles, AKillAtAnyMomentLeavesTheFramesBefore) {
  constexpr int kills = 12, most_frames = 8;
  constexpr std::size_t points = 3000;
  std::mt19937 random(1);
  const Shared written;
  for (int k = 0; k < kills; ++k) {
    fs::remove(vtkhdf());
    *written = 0;
    const pid_t child = fork();
    if (child == 0) {
      const auto series = begin(points);
      for (double time = 0;; ++time, ++*written) series->add(time, arrays_at(points, time));
    }
    const int enough = 1 + static_cast<int>(random() % most_frames);
    while (*written < enough) usleep(50);
    usleep(static_cast<useconds_t>(random() % 2000));  // about the time that a frame takes
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    std::size_t frames = 0;
    ASSERT_NO_THROW(frames = static_cast<std::size_t>(steps(open_hdf5(vtkhdf()))));
    ASSERT_GE(frames, static_cast<std::size_t>(*written));
    // if this array had fewer entries than there are frames, VTK would read beyond its arrays
    ASSERT_EQ(numbers(open_hdf5(vtkhdf()), "VTKHDF/Steps/Values").size(), frames);
    ASSERT_NO_THROW(expect_frames(frames, points));
    // The series can be continued.
    const auto series = begin(points, FieldFormat::vtkhdf, 1e9);
    ASSERT_EQ(series->size(), frames);
    series->add(static_cast<double>(frames), arrays_at(points, static_cast<double>(frames)));
    expect_frames(frames + 1, points);
  }
}

TEST_F(FieldFiles, AFullDiskIsAnErrorThatNamesTheFileAndLeavesTheFramesBefore) {
  constexpr std::size_t points = 20'000;  // 320 kB per frame
  const auto series = begin(points);
  for (int k = 0; k < 3; ++k) series->add(k, arrays_at(points, k));
  const auto bytes = fs::file_size(vtkhdf());
  {
    const FileLimit limit(bytes + 100'000);
    EXPECT_HAS(message_of([&] { series->add(3, arrays_at(points, 3)); }),
               "row.vtkhdf: cannot be written: File too large");
  }
  expect_frames(3, points);
  EXPECT_EQ(fs::file_size(vtkhdf()), bytes);  // the space of the failed frame is freed
  const auto resumed = begin(points, FieldFormat::vtkhdf, 3.0);
  resumed->add(3, arrays_at(points, 3));
  expect_frames(4, points);
}

// After a failed frame the same series continues the file: the frames before the failure stay, and none is skipped.
TEST_F(FieldFiles, AFrameAfterAFailedOneFollowsTheFramesBefore) {
  constexpr std::size_t points = 20'000;  // 320 kB per frame
  const auto series = begin(points);
  for (int k = 0; k < 3; ++k) series->add(k, arrays_at(points, k));
  {
    const FileLimit limit(fs::file_size(vtkhdf()) + 100'000);
    EXPECT_HAS(message_of([&] { series->add(3, arrays_at(points, 3)); }), "row.vtkhdf: cannot be written");
  }
  series->add(3, arrays_at(points, 3));
  EXPECT_EQ(series->size(), 4u);
  expect_frames(4, points);
}

TEST_F(FieldFiles, WhatHasNoFirstFrameLeavesNothing) {
  const FileLimit limit(100'000);
  for (const FieldFormat format : {FieldFormat::vtkhdf, FieldFormat::vtp}) {
    const auto series = begin(20'000, format);
    EXPECT_HAS(message_of([&] { series->add(0, arrays_at(20'000, 0)); }), "cannot be written");
    EXPECT_HAS(message_of([&] { write_fields(stem(), format, row_of_points(20'000), arrays_at(20'000, 0)); }),
               "cannot be written");
  }
  fs::remove(folder_ / "t8.csv");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FieldFiles, AMissingFolderIsNamed) {
  for (const FieldFormat format : {FieldFormat::vtkhdf, FieldFormat::vtp}) {
    const fs::path nowhere = folder_ / "none" / "row";
    const auto series = begin_fields(nowhere, format, row_of_points(2));
    EXPECT_HAS(message_of([&] { series->add(0, arrays_at(2, 0)); }), nowhere.string());
    EXPECT_HAS(message_of([&] { series->add(0, arrays_at(2, 0)); }), "No such file or directory");
    EXPECT_HAS(message_of([&] { write_fields(nowhere, format, row_of_points(2)); }), nowhere.string());
  }
}

/// A series that is resumed at a time drops the frames from this time on.
TEST_F(FieldFiles, AResumedSeriesDropsWhatIsAheadOfIt) {
  constexpr std::size_t points = 100;
  for (int k = 0; k < 6; ++k) {
    const auto series = begin(points, FieldFormat::vtkhdf, k == 0 ? 0 : 1e9);
    series->add(k, arrays_at(points, k));
  }
  {
    const auto series = begin(points, FieldFormat::vtkhdf, 2.5);
    EXPECT_EQ(series->size(), 3U);
    // Even if no frame is added after resuming, the arrays in the file have one entry per remaining frame.
    EXPECT_EQ(numbers(open_hdf5(vtkhdf()), "VTKHDF/Steps/Values").size(), 3U);
    for (const char* name :
         {"NumberOfParts", "PartOffsets", "PointOffsets", "PointDataOffsets/u", "PointDataOffsets/f"})
      EXPECT_EQ(shape(open_hdf5(vtkhdf()), std::string("VTKHDF/Steps/") + name).front(), 3U) << name;
    EXPECT_EQ(shape(open_hdf5(vtkhdf()), "VTKHDF/PointData/u").front(), 3 * points);
    EXPECT_EQ(shape(open_hdf5(vtkhdf()), "VTKHDF/PointData/number").front(), points);
  }
  const auto series = begin(points, FieldFormat::vtkhdf, 2.0);  // the frame at this time is written again
  EXPECT_EQ(series->size(), 2U);
  series->add(2, arrays_at(points, 2));
  expect_frames(3, points);
  EXPECT_EQ(begin(points, FieldFormat::vtkhdf, 0.0)->size(), 0U);
}

TEST_F(FieldFiles, AListOfFramesIsGoneOnWithToo) {
  const auto listed = [&] {
    const std::string all = read(pvd());
    return std::count(all.begin(), all.end(), '\n') -
           5;  // number of lines, except the five lines that do not list a frame
  };
  {
    const auto series = begin(10, FieldFormat::vtp);
    for (int k = 0; k < 4; ++k) series->add(0.1 * k, arrays_at(10, k));
  }
  EXPECT_EQ(listed(), 4);
  EXPECT_HAS(read(pvd()), "<DataSet timestep=\"0.2\" part=\"0\" file=\"row_000002.vtp\"/>");
  const std::string before = read(pvd()), frame = read(folder_ / "row_000003.vtp");
  const auto series = begin(10, FieldFormat::vtp, 0.2);
  EXPECT_EQ(series->size(), 2U);
  EXPECT_EQ(listed(), 2);
  for (int k = 2; k < 4; ++k) series->add(0.1 * k, arrays_at(10, k));
  EXPECT_EQ(read(pvd()), before);
  EXPECT_EQ(read(folder_ / "row_000003.vtp"), frame);
}

TEST_F(FieldFiles, WhatIsNoSeriesOfTheRunIsRefused) {
  const auto refused = [&](FieldFormat format) { return message_of([&] { begin(10, format, 1.0); }); };
  write(vtkhdf(), "not HDF5");
  EXPECT_HAS(refused(FieldFormat::vtkhdf), "row.vtkhdf: fields to continue: found data that cannot be read");
  write(pvd(), "<DataSet timestep=\"x\n");
  EXPECT_HAS(refused(FieldFormat::vtp), "row.pvd: fields to continue: found <DataSet timestep=\"x");
  write(pvd(), "another text\n");
  EXPECT_HAS(refused(FieldFormat::vtp), "a list without its end");
  begin(20)->add(0, arrays_at(20, 0));
  EXPECT_HAS(refused(FieldFormat::vtkhdf), "found 20 points, not 10");
  begin(20)->add(0, arrays_at(20, 0));
  const std::string whole = read(vtkhdf());
  for (const double share : {0.1, 0.5, 0.9}) {
    write(vtkhdf(), whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    EXPECT_HAS(refused(FieldFormat::vtkhdf), "found");
  }
}

}  // namespace
}  // namespace macadam::test
