// SPDX-License-Identifier: GPL-3.0-or-later
// device_test.cpp  Tests how the CUDA device (GPU) is chosen, and for which devices a build contains code.
#include <gtest/gtest.h>

#ifdef MACADAM_CUDA
#include <cuda_runtime_api.h>
#endif

#include "host/backends/choose_devices.hpp"
#include "kernels/cuda/device/compiled_for.hpp"
#include "kernels/make_stepper.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

/// Machine code runs on devices of its own generation; virtual code (PTX) runs on all later generations.
TEST(DeviceCode, MachineCodeServesItsGenerationAndVirtualCodeAllLater) {
  struct Case {
    const char* list;
    int major, minor;
    bool expected;
  };
  for (const Case& c : {Case{"90-real", 9, 0, true},
                        {"90-real", 8, 9, false},
                        {"90-real", 10, 0, false},
                        {"75-virtual,90-real", 7, 5, true},
                        {"75-virtual,90-real", 12, 0, true},
                        {"75-virtual,90-real", 7, 0, false},
                        {"86", 8, 6, true},
                        {"86", 8, 9, true},
                        {"86", 8, 0, false},
                        {"86", 12, 0, true},
                        {"80-real", 8, 9, true},
                        {"89-real,80-real", 8, 6, true},
                        {"120-real,120-virtual", 12, 1, true},
                        {"120-real,120-virtual", 10, 0, false},
                        {"90a", 9, 0, true},
                        {"90a", 10, 0, false},
                        {"native", 3, 5, true},
                        {"", 9, 0, false}}) {
    EXPECT_EQ(kernels::has_code_for(c.list, c.major, c.minor), c.expected)
        << c.list << " on " << c.major << "." << c.minor;
  }
}

/// A specimen of 300,000 contacts or more also uses idle devices, if it has enough contacts to gain from them.
TEST(ChooseDevices, TakesIdleOnesWhereTheyPay) {
  const std::vector<DeviceInfo> devices{{1, "A", 90, 0, 132}, {2, "A", 90, 0, 132}, {4, "A", 90, 0, 132}};
  std::vector<int> asked;
  std::string decision;
  const auto chosen = [&](std::size_t contacts, DeviceList busy) {
    decision.clear();
    asked.clear();
    const auto idle_beside = [&](int device, int first) {
      EXPECT_EQ(first, 1);
      asked.push_back(device);
      return std::count(busy.begin(), busy.end(), device) == 0;
    };
    return choose_devices(contacts, devices, idle_beside, decision);
  };
  EXPECT_EQ(chosen(299'999, {}), DeviceList{1});
  EXPECT_TRUE(asked.empty());
  EXPECT_EQ(decision, "");
  EXPECT_EQ(chosen(300'000, {}), (DeviceList{1, 2}));
  EXPECT_EQ(asked, std::vector{2});
  EXPECT_HAS(decision, "devices 1 and 2: several devices step 300000 contacts faster");
  EXPECT_HAS(decision, "--devices 1 uses only one");
  EXPECT_EQ(chosen(300'000, {2}), (DeviceList{1, 4}));
  EXPECT_EQ(chosen(1'000'000, {}), (DeviceList{1, 2, 4}));
  EXPECT_EQ(chosen(1'000'000, {2, 4}), DeviceList{1});
  EXPECT_EQ(decision, "");
  EXPECT_EQ(choose_devices(1'000'000, {}, {}, decision), DeviceList{});
}

/// Steppers for laws of a user choose backend and precision by the same rules as steppers for Macadam's laws.
TEST(OwnLaws, AreResolvedAsMacadamsAre) {
  const TestScene scene = make_scene(random_specimen(1, 2, 2, 2));
  StepperOptions options = shaking_options(scene);
  const auto make = [&](Backend backend) {  // treats Macadam's laws as laws of another program
    return make_stepper_of<Law, false, Precision::double_, Precision::mixed>(backend, scene.specimen, scene.network,
                                                                             scene.laws, scene.inertia, options);
  };
  for (const Backend backend : {Backend::cpu, Backend::automatic}) {
    // no CUDA kernels are compiled for these laws, so the stepper runs on the CPU even if there is a device
    EXPECT_HAS(make(backend)->description(), "cpu");
    EXPECT_HAS(make(backend)->description(), "double");
  }
  options.precision = Precision::mixed;
  EXPECT_HAS(make(Backend::cpu)->description(), "mixed");
  options.precision = Precision::single;
  EXPECT_HAS(message_of([&] { make(Backend::cpu); }), "precision: found single, expected double or mixed");
  EXPECT_HAS(message_of([&] { make(Backend::reference); }),
             "backend: found \"reference\", expected \"cpu\", \"cuda\" or \"auto\"");
  EXPECT_THROW(make(Backend::reference), InputError);
  EXPECT_THROW(make(Backend::cuda), RunError);
  options.devices = {0};
  EXPECT_THROW(make(Backend::automatic), RunError);
  EXPECT_THROW(make(Backend::cpu), InputError);
}

class Motion : public BackendTest<std::tuple<Backend, Precision>> {};

// The device arrays equal what particles() returns, for each particle. A stepper on the processor has no device arrays.
TEST_P(Motion, OnTheDeviceIsThatOfTheParticles) {
  const TestScene scene = make_scene(random_specimen(4));
  StepperOptions options = shaking_options(scene);
  options.precision = std::get<Precision>(GetParam());
  const auto stepper = make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
  stepper->advance(57);
  const DeviceMotion motion = stepper->device_motion();
  if (backend() == Backend::cpu) {
    EXPECT_EQ(motion.velocity, nullptr);
    EXPECT_EQ(motion.displacement, nullptr);
    return;
  }
#ifdef MACADAM_CUDA
  const std::size_t n = scene.specimen.size();
  ASSERT_EQ(motion.particle.size(), n);
  std::vector<double> u(8 * n), v(8 * n);
  ASSERT_EQ(cudaSetDevice(motion.device), cudaSuccess);
  ASSERT_EQ(cudaMemcpy(u.data(), motion.displacement, u.size() * sizeof(double), cudaMemcpyDeviceToHost), cudaSuccess);
  if (motion.doubles) {
    ASSERT_EQ(cudaMemcpy(v.data(), motion.velocity, v.size() * sizeof(double), cudaMemcpyDeviceToHost), cudaSuccess);
  } else {
    std::vector<float> single(v.size());
    ASSERT_EQ(cudaMemcpy(single.data(), motion.velocity, single.size() * sizeof(float), cudaMemcpyDeviceToHost),
              cudaSuccess);
    v.assign(single.begin(), single.end());
  }
  EXPECT_EQ(motion.doubles, options.precision != Precision::single);
  const ParticleState state = stepper->particles();
  std::vector<int> seen(n, 0);
  for (std::size_t b = 0; b < n; ++b) {
    const auto i = static_cast<std::size_t>(motion.particle[b]);
    ASSERT_LT(i, n);
    ++seen[i];
    const auto same = [&](const double* words, const Vec3d& of) {
      EXPECT_EQ(words[0], of.x);
      EXPECT_EQ(words[1], of.y);
      EXPECT_EQ(words[2], of.z);
    };
    same(&u[8 * b], state.displacement[i]);
    same(&u[8 * b + 4], state.rotation[i]);
    same(&v[8 * b], state.velocity[i]);
    same(&v[8 * b + 4], state.spin[i]);
  }
  EXPECT_EQ(seen, std::vector<int>(n, 1));
#endif
}

INSTANTIATE_TEST_SUITE_P(All, Motion,
                         testing::Combine(all_backends(),
                                          testing::Values(Precision::double_, Precision::mixed, Precision::single)),
                         [](const auto& info) { return name_of_case(info); });

TEST(DeviceChoice, BesideAnotherBackendIsRefused) {
  for (const Backend backend : {Backend::cpu, Backend::reference}) {
    EXPECT_HAS(message_of([&] { select_backend(backend, nullptr, {0}); }), "device: found 0 with backend");
    EXPECT_THROW(select_backend(backend, nullptr, {0}), InputError);
    EXPECT_EQ(select_backend(backend), backend);
  }
}

TEST(DeviceChoice, WithoutACudaDeviceIsAnErrorThatSaysWhy) {
  const BackendReport report = report_backends();
  if (!report.devices.empty()) GTEST_SKIP() << report.cuda_status;
  for (const Backend backend : {Backend::automatic, Backend::cuda}) {
    const auto choose = [&] { select_backend(backend, nullptr, {0}); };
    EXPECT_THROW(choose(), RunError);
    EXPECT_HAS(message_of(choose), report.cuda_status);
  }
}

TEST(DeviceChoice, OfACudaDeviceThatIsNotThereListsThoseThatAre) {
  const BackendReport report = report_backends();
  if (report.devices.empty()) GTEST_SKIP() << report.cuda_status;
  for (const int number : {-2, 1023}) {
    const auto choose = [&] { select_backend(Backend::automatic, nullptr, {number}); };
    EXPECT_THROW(choose(), InputError);
    EXPECT_HAS(message_of(choose), "found " + std::to_string(number));
    EXPECT_HAS(message_of(choose), report.cuda_status);
    for (const DeviceInfo& d : report.devices) {
      EXPECT_HAS(message_of(choose), std::to_string(d.number) + " (" + d.name + ")");
    }
  }
}

// Steppers on different devices may be used in turn, because each selects its own device for the calling thread.
TEST(DeviceChoice, EveryCudaDeviceTakesTheSameSteps) {
  const BackendReport report = report_backends();
  if (report.devices.empty()) GTEST_SKIP() << report.cuda_status;
  const TestScene scene = make_scene(random_specimen(4));
  StepperOptions options = slow_options(scene);
  options.precision = Precision::mixed;
  std::vector<std::unique_ptr<Stepper>> steppers;
  for (const DeviceInfo& d : report.devices) {
    options.devices = {d.number};
    std::string reason;
    EXPECT_EQ(select_backend(Backend::automatic, &reason, {d.number}), Backend::cuda);
    EXPECT_EQ(reason, d.name);
    steppers.push_back(make_stepper(Backend::cuda, scene.specimen, scene.network, scene.laws, scene.inertia, options));
    EXPECT_HAS(steppers.back()->description(), d.name);
    if (d.number > 0) { EXPECT_HAS(steppers.back()->description(), "device " + std::to_string(d.number)); }
  }
  for (int part = 0; part < 3; ++part) {
    for (const auto& stepper : steppers) stepper->advance(100);
  }
  for (std::size_t i = 0; i < steppers.size(); ++i) {
    EXPECT_EQ(steppers[i]->observe().step, 300);
    if (report.devices[i].name != report.devices[0].name) continue;  // another type may divide the work differently
    EXPECT_EQ(steppers[i]->observe().top_force(), steppers[0]->observe().top_force());
  }
}

}  // namespace
}  // namespace macadam::test
