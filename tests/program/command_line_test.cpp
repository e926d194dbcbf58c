// SPDX-License-Identifier: GPL-3.0-or-later
// command_line_test.cpp  Runs the program as a user does, and checks exit codes, messages and files.
#include <map>
#include <regex>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using CommandLine = Program;

TEST_F(CommandLine, InfoNamesVersionBackendsAndChoice) {
  const Outcome info = macadam("info");
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_TRUE(contains(info.out, std::string("macadam ") + version())) << info.out;
  for (const char* word : {"cpu", "reference", "cuda", "auto"}) EXPECT_TRUE(contains(info.out, word)) << word;
  EXPECT_TRUE(contains(info.out, report_backends().cuda_status)) << info.out;
  EXPECT_TRUE(contains(macadam("--version").out, version()));
}

TEST_F(CommandLine, HelpOnEachCommand) {
  const std::map<std::string, std::vector<std::string>> expected{
      {"", {"run", "specimen", "info"}},
      {"run", {"--out", "--backend", "--precision", "--threads", "--device", "scene"}},
      {"specimen", {"--out", "scene", "--section"}},
      {"info", {"--help"}}};
  for (const auto& [command, words] : expected) {
    const Outcome help = macadam(command + " --help");
    EXPECT_EQ(help.code, 0) << command;
    for (const auto& word : words) EXPECT_TRUE(contains(help.out, word)) << command << ": " << word;
  }
}

TEST_F(CommandLine, WrongUsageIsExitCodeTwo) {
  write_scene();
  const std::string job = path("scene.toml") + " --out " + path("out");
  for (const std::string& arguments : std::vector<std::string>{
           "", "fly", "info --colour", "run " + path("scene.toml"), "run --out x", "run " + job + " --frobnicate",
           "run " + job + " --backend gpu", "run " + job + " --precision half", "run " + job + " --threads 0",
           "run " + job + " --threads two", "run " + job + " --device -1", "run " + job + " --device one",
           "specimen " + job + " --threads 1"}) {
    const Outcome outcome = macadam(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  const std::string seeds = "expected a whole number from 0 to 18446744073709551615";
  for (const auto& [arguments, message] : std::map<std::string, std::string>{
           {"run " + job + " --frobnicate", "found \"--frobnicate\", expected one of --help, --out"},
           {"run " + job + " --backend gpu", "--backend: found \"gpu\", expected one of auto|cuda|cpu|reference"},
           {"run " + job + " --backend 3", "--backend: found \"3\""},
           {"run " + job + " --seed -1", "--seed: found \"-1\", " + seeds},
           {"run " + job + " --seed 18446744073709551616", seeds},
           {"run " + job + " --seed ''", "--seed: found \"\", " + seeds},
           {"run " + job + " --seed 0x10", seeds},
           {"run " + job + " --threads '2 '", "--threads: found \"2 \", expected a whole number from 1 to 1024"},
           {"run " + path("scene.toml") + " -o out", "found \"-o\", expected --out (the nearest of "},
           {"run " + path("scene.toml") + " --out ''", "--out: found \"\""},
           {"runn " + job,
            "found \"runn\", expected run (the nearest of run, specimen, shapes, fit, calibrate, ct, info, "
            "new, check, bench, report, mixture, mcp, study, completion, man)"},
           {"run " + job + " more", "more: scene: found no such file"},
           {"run " + job + " --device 0,x",
            "--device: found \"0,x\", expected \"all\", or different whole numbers from 0"},
           {"run " + job + " --devices 1,1", "found \"1,1\", expected \"all\", or different"},
           {"shapes fil", "found \"fil\", expected fill (the nearest of "},
           {"specimen " + job + " more", "found \"more\", expected nothing more"},
           {"specimen -- " + path("scene.toml"), "--out is required"},
           {"", "found no command, expected one of run, specimen, shapes, fit, calibrate, ct, info"},
           {"shapes fill x --out y --radius 1 --scale 0", "--scale: found \"0\", expected a number from 1e-12 to "}}) {
    const Outcome outcome = macadam(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_TRUE(contains(outcome.err, message)) << arguments << ": " << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

/// `macadam report` runs the Python that MACADAM_PYTHON names. An empty MACADAM_PYTHON counts as unset.
TEST_F(CommandLine, ReportsAreMadeByThePythonThatIsNamedIfOneIs) {
  for (const char* name : {"python3", "named"}) {
    std::ofstream(folder_ / name) << "#!/bin/sh\necho " << name << " \"$@\"\n";
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  const auto report = [&](const std::string& python) {
    const std::string out = (folder_ / "out.txt").string();
    const int status =
        std::system(fmt::format("env -u MACADAM_PYTHON PATH='{}':\"$PATH\" {} '{}' report --help >'{}' 2>&1 </dev/null",
                                folder_.string(), python, MACADAM_PROGRAM, out)
                        .c_str());
    return std::pair{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out)};
  };
  EXPECT_EQ(report("MACADAM_PYTHON=" + path("named")), (std::pair{0, std::string("named -m macadam report --help\n")}));
  const auto unnamed = report("");  // uses scripts/python if this exists
  EXPECT_EQ(unnamed.first, 0) << unnamed.second;
  EXPECT_EQ(report("MACADAM_PYTHON="), unnamed);
}

// CLI11 prints an enumeration as its number, which would appear as a control character.
TEST_F(CommandLine, HelpIsPlainText) {
  for (const char* command : {"run", "specimen", "shapes fill", "shapes measure", "shapes generate", "info", ""}) {
    const std::string help = macadam(std::string(command) + " --help").out;
    for (const char c : help) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= ' ') << command << int{c};
  }
  EXPECT_TRUE(contains(macadam("run --help").out, "--backend auto|cuda|cpu|reference"));
}

// A leading zero does not make a number octal: seeds 010 and 10 give the same specimen, seed 8 another.
TEST_F(CommandLine, NumbersAreDecimal) {
  std::ofstream(folder_ / "made.toml") << "[specimen]\nbox = [0.004, 0.004, 0.004]\n[specimen.mastic]\n"
                                          "radius = [\"0.4 mm\", \"0.5 mm\"]\ncount = 60\n"
                                          "[loading]\nkind = \"cyclic\"\nfrequencies = [20.0]\n"
                                       << am1_contacts;
  for (const char* seed : {"010", "10", "8"}) {
    const Outcome made = macadam(fmt::format("specimen {} --out {} --seed {}", path("made.toml"), path(seed), seed));
    ASSERT_EQ(made.code, 0) << made.err;
  }
  EXPECT_EQ(read(folder_ / "010/specimen.csv"), read(folder_ / "10/specimen.csv"));
  EXPECT_NE(read(folder_ / "010/specimen.csv"), read(folder_ / "8/specimen.csv"));
}

TEST_F(CommandLine, WrongInputIsExitCodeTwoAndNamesTheLine) {
  for (const char* command : {"run", "specimen"}) {
    const auto job = [&](const std::string& scene) {
      return macadam(fmt::format("{} {} --out {}", command, path(scene), path("out")));
    };
    const Outcome missing = job("nowhere.toml");
    EXPECT_EQ(missing.code, 2);
    EXPECT_TRUE(contains(missing.err, "nowhere.toml")) << missing.err;

    write_scene("density_scalling = 1e6\n");  // the misspelt key is in line 9 of the scene
    const Outcome misspelt = job("scene.toml");
    EXPECT_EQ(misspelt.code, 2);
    EXPECT_TRUE(contains(misspelt.err, "scene.toml:9:")) << misspelt.err;
    EXPECT_TRUE(contains(misspelt.err, "density_scaling")) << misspelt.err;

    write_scene();
    fs::rename(folder_ / "t8.csv", folder_ / "moved.csv");
    const Outcome no_specimen = job("scene.toml");
    EXPECT_EQ(no_specimen.code, 2);
    EXPECT_TRUE(contains(no_specimen.err, "t8.csv")) << no_specimen.err;
    fs::rename(folder_ / "moved.csv", folder_ / "t8.csv");

    std::string text = read(folder_ / "t8.csv");
    std::ofstream(folder_ / "t8.csv") << text << "175,0.001,0.001,0.001,-0.5,mastic,-1\n";
    const Outcome bad_particle = job("scene.toml");
    EXPECT_EQ(bad_particle.code, 2);
    EXPECT_TRUE(contains(bad_particle.err, "175")) << bad_particle.err;
    std::ofstream(folder_ / "t8.csv") << text;
  }
}

TEST_F(CommandLine, SpecimenWritesParticlesAndContacts) {
  write_scene(quick, "[output]\ncontacts = true\n");
  const Outcome outcome = macadam("specimen " + path("scene.toml") + " --out " + path("made/here"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "175 particles")) << outcome.out;
  const auto particles = lines_of(read(folder_ / "made/here/specimen.csv"));
  EXPECT_EQ(particles.size(), 176u);
  EXPECT_EQ(particles[0], "id,x,y,z,radius,phase,body");
  const auto contacts = lines_of(read(folder_ / "made/here/contacts.csv"));
  EXPECT_EQ(contacts[0], "a,b,pair,area,distance,nx,ny,nz,points");
  const auto summary = this->summary("made/here");
  EXPECT_EQ(summary.at("status"), "prepared");
  EXPECT_TRUE(summary.at("results").empty());
  std::size_t count = 0;
  for (const auto& [pair, number] : summary.at("contacts").items()) count += number.get<std::size_t>();
  EXPECT_EQ(contacts.size(), count + 1);
  EXPECT_FALSE(fs::exists(folder_ / "made/here/response.csv"));
}

TEST_F(CommandLine, SpecimenIsCutByPlanes) {
  write_scene();
  const std::string job = "specimen --section x=0.004 " + path("scene.toml") + " --out " + path("out");
  const Outcome outcome = macadam(job + " --section 'z=2.50 mm'");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "section z=0.0025 m: ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "of the area is aggregate")) << outcome.out;
  for (const char* name : {"section_x_0.004.csv", "section_z_0.0025.csv"}) {
    const auto section = lines_of(read(folder_ / "out" / name));
    EXPECT_EQ(section[0], "particle,phase,body,x,y,z");
    EXPECT_GT(section.size(), 100u);
  }
  fs::remove_all(folder_ / "out");
  for (const char* plane : {"x=0.009", "y=-0.001", "w=0.001", "x=left", "x", "z=11"}) {
    const Outcome bad = macadam(job + " --section " + plane);
    EXPECT_EQ(bad.code, 2) << plane;
    EXPECT_TRUE(contains(bad.err, "section")) << bad.err;
    EXPECT_TRUE(contains(bad.err, "expected")) << bad.err;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << plane;
  }
}

TEST_F(CommandLine, RunWritesItsFilesWithoutProgressText) {
  write_scene();
  const Outcome outcome = run_quick("out");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.find_first_of("\r\033"), std::string::npos);
  EXPECT_TRUE(contains(outcome.out, "|E*| (GPa)")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, (folder_ / "out").string())) << outcome.out;
  const auto response = lines_of(read(folder_ / "out/response.csv"));
  EXPECT_EQ(response.size(), 502u);  // header, start, 500 samples
  EXPECT_EQ(response[0], "frequency_hz,time_s,strain,stress_pa");
  EXPECT_EQ(lines_of(read(folder_ / "out/specimen.csv")).size(), 176u);
  EXPECT_FALSE(fs::exists(folder_ / "out/contacts.csv"));  // the scene does not ask for contacts
  const auto summary = this->summary("out");
  EXPECT_EQ(summary.at("status"), "done");
  EXPECT_EQ(summary.at("solver").at("backend"), "cpu");
  EXPECT_EQ(summary.at("solver").at("steps"), 500);
  EXPECT_GT(summary.at("results").at(0).at("e_star_pa"), 1e9);
}

TEST_F(CommandLine, SameSceneSameBytes) {
  write_scene("density_scaling = 1e5\n");
  const std::vector<std::string> options{"--threads 1", "--threads 1", "--threads 2", ""};
  std::vector<std::string> responses;
  for (const auto& option : options) {
    ASSERT_EQ(run_quick("out", "--backend cpu " + option).code, 0);
    responses.push_back(read(folder_ / "out/response.csv"));
  }
  EXPECT_GT(responses[0].size(), 500u * 20);
  for (std::size_t k = 1; k < options.size(); ++k) EXPECT_TRUE(responses[k] == responses[0]) << options[k];
}

// The command line overrides the scene. Rounding of 500 steps in single precision is at most 500·2⁻²⁴ = 3e-5.
TEST_F(CommandLine, OtherPrecisionsAndTheReferenceRun) {
  write_scene();
  ASSERT_EQ(run_quick("double").code, 0);
  const double expected = summary("double").at("results").at(0).at("e_star_pa");
  struct Choice {
    const char *options, *backend, *precision;
    double tolerance;
  };
  for (const Choice& c : {Choice{"--backend cpu --precision single", "cpu", "single", 3e-5},
                          Choice{"--backend cpu --precision mixed", "cpu", "mixed", 3e-5},
                          Choice{"--backend reference", "reference", "double", 1e-10}}) {
    const Outcome outcome = run_quick("other", c.options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, c.precision)) << outcome.out;
    const auto other = summary("other");
    EXPECT_EQ(other.at("solver").at("backend"), c.backend);
    EXPECT_EQ(other.at("solver").at("precision"), c.precision);
    const double found = other.at("results").at(0).at("e_star_pa");
    EXPECT_NEAR(found / expected, 1, c.tolerance) << c.options;
    EXPECT_TRUE(found != expected) << c.options << ": did it run at all?";
  }
}

TEST_F(CommandLine, CudaWithoutADeviceFailsAndLeavesOldResultsAlone) {
  write_scene();
  ASSERT_EQ(run_quick("out").code, 0);
  const std::string response = read(folder_ / "out/response.csv"), summary = read(folder_ / "out/summary.json");
  const Outcome cuda = run_quick("out", "--backend cuda");
  if (!report_backends().devices.empty()) {
    EXPECT_EQ(cuda.code, 0) << cuda.err;
    EXPECT_EQ(this->summary("out").at("solver").at("backend"), "cuda");
    return;
  }
  EXPECT_EQ(cuda.code, 1);
  EXPECT_TRUE(contains(cuda.err, "cuda") && contains(cuda.err, "cpu"))
      << cuda.err;  // the unavailable backend, and one to use instead
  EXPECT_TRUE(contains(cuda.err, report_backends().cuda_status)) << cuda.err;  // the reason
  EXPECT_TRUE(read(folder_ / "out/response.csv") == response);
  EXPECT_TRUE(read(folder_ / "out/summary.json") == summary);
}

TEST_F(CommandLine, ACudaDeviceIsChosenByNumber) {
  write_scene();
  ASSERT_EQ(run_quick("cpu", "--backend cpu").code, 0);
  const Outcome beside = run_quick("beside", "--backend cpu --device 0");
  EXPECT_EQ(beside.code, 2);
  EXPECT_TRUE(contains(beside.err, "device: found 0 with backend cpu, expected backend cuda or auto")) << beside.err;
  const BackendReport report = report_backends();
  const Outcome missing = run_quick("missing", "--device 1023");
  EXPECT_TRUE(contains(missing.err, report.cuda_status)) << missing.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "missing/summary.json"));
  EXPECT_EQ(missing.code, report.devices.empty() ? 1 : 2) << missing.err;
  const Outcome info = macadam("info");
  for (const DeviceInfo& d : report.devices) {
    EXPECT_TRUE(contains(info.out, fmt::format("device {}: {}, ", d.number, d.name))) << info.out;
    EXPECT_TRUE(contains(missing.err, fmt::format("{} ({})", d.number, d.name))) << missing.err;
    const Outcome one = run_quick(fmt::format("device_{}", d.number), fmt::format("--device {}", d.number));
    EXPECT_EQ(one.code, 0) << one.err;
    const std::string solver = summary(fmt::format("device_{}", d.number)).at("solver").at("description");
    EXPECT_TRUE(
        contains(solver, d.number > 0 ? fmt::format("cuda device {}, {}", d.number, d.name) : "cuda, " + d.name))
        << solver;
  }
}

// The device number in the scene belongs to the scene's backend. If the command line names another backend, the number
// is ignored.
TEST_F(CommandLine, AnotherBackendDoesWithoutTheScenesCudaDevice) {
  write_scene(quick, "device = 1023\n");
  EXPECT_NE(run_quick("scene", "").code, 0);
  EXPECT_EQ(run_quick("cpu", "--backend cpu").code, 0);
}

// A step of 1e-4 s is 1.5 times the largest stable step for this mass. The motion grows for some samples before the run
// counts as diverged.
TEST_F(CommandLine, ADivergingRunNamesAParticleAndKeepsItsFiles) {
  write_scene("density_scaling = 2e5\ntime_step = 1e-4\n");
  const Outcome outcome = run_quick("out");
  EXPECT_EQ(outcome.code, 1);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(outcome.err, found, std::regex("particle ([0-9]+) .*at t = ([0-9.e+-]+) s")))
      << outcome.err;
  EXPECT_LT(std::stoi(found[1]), 175);
  const double failed_at = std::stod(found[2]);

  const std::string text = read(folder_ / "out/response.csv");
  EXPECT_EQ(text.back(), '\n');
  const auto response = lines_of(text);
  ASSERT_GT(response.size(), 3u);
  ASSERT_LT(response.size(), 502u);
  double time = -1;
  for (std::size_t k = 1; k < response.size(); ++k) {
    double f = 0, strain = 0, stress = 0;
    int end = 0;
    ASSERT_EQ(std::sscanf(response[k].c_str(), "%lf,%lf,%lf,%lf%n", &f, &time, &strain, &stress, &end), 4);
    ASSERT_EQ(static_cast<std::size_t>(end), response[k].size()) << response[k];
    ASSERT_TRUE(std::isfinite(stress)) << response[k];
  }
  EXPECT_NEAR(failed_at - time, 1e-4, 1e-7);  // the run stopped one sample after the last finite one
  const auto summary = this->summary("out");
  EXPECT_EQ(summary.at("status").get<std::string>().rfind("failed", 0), 0u) << summary.at("status");
  EXPECT_TRUE(contains(summary.at("status"), "particle " + found[1].str()));
  EXPECT_TRUE(summary.at("results").empty());
  EXPECT_EQ(lines_of(read(folder_ / "out/specimen.csv")).size(), 176u);
}

TEST_F(CommandLine, AFolderThatCannotBeMadeIsExitCodeOne) {
  write_scene();
  std::ofstream(folder_ / "file") << "in the way\n";
  for (const char* out : {"file", "file/below"}) {
    for (const char* command : {"run", "specimen"}) {
      const Outcome outcome = macadam(fmt::format("{} {} --out {}", command, path("scene.toml"), path(out)));
      EXPECT_EQ(outcome.code, 1) << outcome.err;
      EXPECT_TRUE(contains(outcome.err, (folder_ / out).string())) << outcome.err;
    }
  }
  EXPECT_EQ(read(folder_ / "file"), "in the way\n");
}

// The harmonic method gives the recorded modulus of t8 at 20 Hz to all recorded digits. The response file of an earlier
// stepped run is removed.
TEST_F(CommandLine, HarmonicMethodGivesTheKnownNumber) {
  write_scene();
  ASSERT_EQ(run_quick("out").code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "out/response.csv"));
  write_scene("method = \"harmonic\"\n");
  const Outcome outcome = run_quick("out");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "11.69667")) << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "out/response.csv"));
  const auto summary = nlohmann::json::parse(read(folder_ / "out/summary.json"));
  EXPECT_EQ(summary.at("status"), "done");
  const auto& result = summary.at("results").at(0);
  EXPECT_EQ(result.at("method"), "harmonic");
  EXPECT_NEAR(result.at("e_star_pa").get<double>(), 11.69667e9, 0.51e4);
  EXPECT_NEAR(result.at("phase_deg").get<double>(), 6.97771, 0.51e-5);
  EXPECT_LE(result.at("residual").get<double>(), 1e-11);
}

TEST_F(CommandLine, AFileThatCannotBeWrittenIsExitCodeOne) {
  write_scene();
  fs::create_directories(folder_ / "out/response.csv");  // a folder in place of the file
  const Outcome outcome = run_quick("out");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "response.csv")) << outcome.err;
}

}  // namespace
}  // namespace macadam::test
