// SPDX-License-Identifier: GPL-3.0-or-later
// gpu_step_bench.cpp  The time of a step on a CUDA device, by device events; a table, and CSV with --csv FILE.
//
//   gpu_step_bench [--large] [--huge] [--specimen NAME=FILE] [--csv FILE] [FILTER]
//
// Rows whose name contains FILTER, or all. --large adds a million particles, --huge ten million, --specimen the
// particles of a specimen.csv in the paper's box: `macadam specimen` makes it of a scene of examples/. Every time is
// the median of seven runs of at least 50 ms of steps at 20 Hz and true mass, everything in motion. `copy` is the
// bandwidth of a copy within the device's memory in the same run, bytes read plus written.
#include <cuda_runtime.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>

#include "bench/fcc_network.hpp"

namespace macadam::bench {
namespace {

void check(cudaError_t status) {
  if (status != cudaSuccess) throw RunError(cudaGetErrorString(status));
}

/// Milliseconds that the device takes for what f queues.
double milliseconds(const std::function<void()>& f) {
  cudaEvent_t begin, end;
  check(cudaEventCreate(&begin));
  check(cudaEventCreate(&end));
  check(cudaEventRecord(begin));
  f();
  check(cudaEventRecord(end));
  check(cudaEventSynchronize(end));
  float out = 0;
  check(cudaEventElapsedTime(&out, begin, end));
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  return out;
}
double median(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list[list.size() / 2];
}
double median_of(int runs, const std::function<void()>& f) {
  std::vector<double> out;
  for (int k = 0; k < runs; ++k) out.push_back(milliseconds(f));
  return median(out);
}

double copy_bandwidth() {
  constexpr std::size_t size = std::size_t{1} << 30;
  void *from = nullptr, *to = nullptr;
  check(cudaMalloc(&from, size));
  check(cudaMalloc(&to, size));
  check(cudaMemset(from, 1, size));
  const auto copy = [&] { check(cudaMemcpyAsync(to, from, size, cudaMemcpyDeviceToDevice)); };
  copy();
  const double ms = median_of(9, copy);
  cudaFree(from);
  cudaFree(to);
  return 2 * size / (ms * 1e-3);
}

struct Row {
  ContactForm form;
  Precision precision;
  Geometry geometry;
};

class Table {
 public:
  Table(std::string filter, const std::string& csv, const DeviceList& devices) : devices_(devices), filter_(std::move(filter)), copy_(copy_bandwidth()) {
    cudaDeviceProp p{};
    int driver = 0, clock = 0;
    check(cudaGetDeviceProperties(&p, 0));
    check(cudaDriverGetVersion(&driver));
    check(cudaDeviceGetAttribute(&clock, cudaDevAttrClockRate, 0));
    fmt::print("{}, {} multiprocessors, {} MB L2, up to {} MHz, driver for CUDA {}.{}, copy {:.2f} TB/s\n", p.name,
               p.multiProcessorCount, p.l2CacheSize >> 20, clock / 1000, driver / 1000, driver % 1000 / 10,
               copy_ / 1e12);
    fmt::print("{:44} {:>10} {:>12} {:>10} {:>8} {:>8} {:>24}  {}\n", "step", "us", "contacts/s", "B/contact",
               "of copy", "B held", "registers (occupancy)", "path");
    if (!csv.empty()) csv_.open(csv);
    if (csv_)
      csv_ << "step,particles,contacts,us,contacts_per_s,bytes_per_contact,share_of_copy,held_bytes_per_contact,"
              "registers (occupancy),path\n";
  }

  void run(const std::string& scene_name, const std::function<const test::TestScene&()>& make, const Row& row,
           double frequency = 20) {
    const std::string name =
        fmt::format("{}/{}/{}/{}", scene_name, to_string(row.form), to_string(row.precision), to_string(row.geometry));
    if (name.find(filter_) == std::string::npos) return;
    const test::TestScene& scene = make();
    StepperOptions options;
    options.form = row.form;
    options.precision = row.precision;
    options.geometry = row.geometry;
    options.devices = devices_;
    const double dt = 0.8 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
    drives::Cyclic loading{1e-4 * scene.specimen.box.size.z, frequency, 1, 0};
    loading.steps_per_period = std::llround(std::ceil(1 / (frequency * dt)));
    options.boundary = moving_top(loading);
    options.dt = loading.dt();
    const auto stepper = make_stepper(Backend::cuda, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    std::mt19937 random(2);
    std::vector<Vec3d> v(scene.specimen.size()), w(scene.specimen.size());
    const auto draw = [&](double most) { return most * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    for (std::size_t i = 0; i < v.size(); ++i) {
      v[i] = {draw(1e-4), draw(1e-4), draw(1e-4)};
      w[i] = {draw(1e-1), draw(1e-1), draw(1e-1)};
    }
    stepper->set_velocities(v, w);
    stepper->advance(256);
    std::int64_t steps = 256;
    while (milliseconds([&] { stepper->advance(steps); }) < 50) steps *= 2;
    const double us = 1e3 * median_of(7, [&] { stepper->advance(steps); }) / static_cast<double>(steps);
    if (stepper->first_divergent() >= 0) throw RunError(name + " diverged");
    const double contacts = static_cast<double>(scene.network.contacts.size());
    const double bytes = static_cast<double>(stepper->traffic());
    const double share = bytes / (us * 1e-6) / copy_;
    const double held = static_cast<double>(stepper->bytes()) / contacts;
    std::string use;
    for (const KernelUse& k : stepper->kernels())
      use += fmt::format("{}{} ({:.2f})", use.empty() ? "" : " ", k.registers, k.occupancy);
    fmt::print("{:44} {:10.2f} {:12.3e} {:10.0f} {:8.2f} {:8.0f} {:>24}  {}\n", name, us, contacts / (us * 1e-6),
               bytes / contacts, share, held, use, stepper->description());
    std::fflush(stdout);
    if (csv_) {
      csv_ << fmt::format("\"{}\",{},{},{:.3f},{:.4g},{:.1f},{:.3f},{:.1f},{},\"{}\"\n", name, scene.specimen.size(),
                          contacts, us, contacts / (us * 1e-6), bytes / contacts, share, held, use,
                          stepper->description());
      csv_.flush();
    }
  }

 private:
  DeviceList devices_;
  std::string filter_;
  double copy_;
  std::ofstream csv_;
};

/// The laws of [1] with so many Kelvin units, of the same sum of compliances.
test::Laws laws_of_units(int units) {
  test::Laws laws = test::am1_laws();
  for (auto& law : laws) {
    auto* kelvin = law ? std::get_if<laws::GeneralisedKelvin>(&*law) : nullptr;
    if (!kelvin) continue;
    kelvin->E.assign(static_cast<std::size_t>(units), units * kelvin->E.front());
    kelvin->C.assign(static_cast<std::size_t>(units), units * kelvin->C.front());
  }
  return laws;
}

void run_all(Table& table, bool large, bool huge, const std::string& given, const std::vector<std::size_t>& sizes) {
  constexpr auto condensed = ContactForm::condensed, points = ContactForm::points;
  constexpr auto fixed = Geometry::fixed, updated = Geometry::updated;
  constexpr auto single = Precision::single, mixed = Precision::mixed, full = Precision::double_;
  const Box box{{0.05, 0.05, 0.08}};  // of the paper's specimens
  const auto specimen = [&](const test::Laws& laws) {
    return test::make_scene(read_specimen_csv(MACADAM_TEST_DATA "/ss_full.csv.gz", box), {}, laws);
  };
  std::optional<test::TestScene> scene;
  const auto keep = [&](const std::function<test::TestScene()>& make) {
    return [&scene, make]() -> const test::TestScene& {
      if (!scene) scene = make();
      return *scene;
    };
  };
  const auto am1 = keep([&] { return specimen(test::am1_laws()); });
  for (const Precision p : {single, mixed, full}) {
    table.run("full", am1, {condensed, p, fixed});
    table.run("full", am1, {condensed, p, updated});
  }
  table.run("full", am1, {points, full, fixed});
  table.run("full", am1, {points, full, updated});
  scene.reset();
  const auto elastic = keep([&] {
    test::Laws laws = test::am1_laws();
    for (auto& law : laws) law = laws::Elastic{std::visit([](const auto& l) { return l.instantaneous(); }, *law), 0.1};
    return specimen(laws);
  });
  table.run("full, elastic", elastic, {condensed, mixed, fixed});
  scene.reset();
  for (const int units : {0, 1, 2, 4, 5, 6}) {
    table.run(fmt::format("full, {} units", units), keep([&, units] { return specimen(laws_of_units(units)); }),
              {condensed, full, fixed});
    scene.reset();
  }
  if (const auto sign = given.find('='); sign != std::string::npos) {
    const auto of_file = keep([&] { return test::make_scene(read_specimen_csv(given.substr(sign + 1), box)); });
    for (const Precision p : {single, mixed, full}) table.run(given.substr(0, sign), of_file, {condensed, p, fixed});
    table.run(given.substr(0, sign), of_file, {condensed, mixed, updated});
    scene.reset();
  }
  const auto fcc = [&](std::size_t n) { return keep([n] { return fcc_scene(n); }); };
  table.run("fcc 62,500", fcc(62500), {condensed, mixed, fixed});
  table.run("fcc 62,500", fcc(62500), {condensed, full, fixed});
  scene.reset();
  for (const auto& [size, number] : {std::pair{"fcc 1e3", 1000}, {"fcc 1e4", 10000}, {"fcc 1e5", 100000}}) {
    const auto scene_of = fcc(static_cast<std::size_t>(number));
    for (const Precision p : {single, mixed, full}) table.run(size, scene_of, {condensed, p, fixed});
    table.run(size, scene_of, {points, full, fixed});
    scene.reset();
  }
  if (large) {
    for (const Precision p : {single, mixed, full}) table.run("fcc 1e6", fcc(1000000), {condensed, p, fixed});
    scene.reset();
  }
  if (huge) table.run("fcc 1e7", fcc(10000000), {condensed, single, fixed});
  for (const std::size_t n : sizes) {
    table.run(fmt::format("fcc {}", n), fcc(n), {condensed, single, fixed});
    scene.reset();
  }
}

int run_main(int argc, char** argv) {
  std::string filter, csv, given;
  bool large = false, huge = false;
  DeviceList devices;
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--large"))
      large = true;
    else if (!std::strcmp(argv[i], "--huge"))
      huge = true;
    else if (!std::strcmp(argv[i], "--specimen") && i + 1 < argc)
      given = argv[++i];
    else if (!std::strcmp(argv[i], "--csv") && i + 1 < argc)
      csv = argv[++i];
    else if (!std::strcmp(argv[i], "--fcc") && i + 1 < argc)
      sizes.push_back(static_cast<std::size_t>(std::atof(argv[++i])));
    else if (!std::strcmp(argv[i], "--all-devices"))
      devices = {every_device};
    else
      filter = argv[i];
  }
  Table table(filter, csv, devices);
  run_all(table, large, huge, given, sizes);
  return 0;
}

}  // namespace
}  // namespace macadam::bench

int main(int argc, char** argv) {
  try {
    return macadam::bench::run_main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
