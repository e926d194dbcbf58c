// SPDX-License-Identifier: GPL-3.0-or-later
// read_history.cpp  Reads `[loading]` of kind "history": the drive, its values, and the file of a table.
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <map>
#include <string_view>
#include <tuple>

#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace scene {
namespace {

using drives::AnySpec;
using drives::TableSpec;

// as for kind "monotonic"
constexpr Rule any_strain{[](double v) { return v > -1 && v <= 10; }, "a strain above -1 and at most 10"};
constexpr Rule a_strain{[](double v) { return v != 0 && v > -1 && v <= 10; },
                        "a strain above -1 and at most 10, not 0"};
constexpr Rule not_zero{[](double v) { return v != 0; }, "a rate that is not 0"};
constexpr std::int64_t most_number = 1'000'000'000;

/// Return the reader of a value of a drive, by its type and kind.
/// @{
const Quantity& unit_of_kind(drives::ValueKind kind) {
  switch (kind) {
    case drives::ValueKind::strain:
    case drives::ValueKind::number:
      return ratio;
    case drives::ValueKind::rate:
      return rate;
    case drives::ValueKind::frequency:
      return frequency;
    case drives::ValueKind::time:
    case drives::ValueKind::pause:
      return duration;
  }
  throw RunError("read_history: a kind of value without a unit");
}
const Rule& rule_of_kind(drives::ValueKind kind, bool list) {
  switch (kind) {
    case drives::ValueKind::strain:
      return list ? any_strain : a_strain;
    case drives::ValueKind::rate:
      return not_zero;
    case drives::ValueKind::pause:
      return non_negative;
    case drives::ValueKind::number:
    case drives::ValueKind::frequency:
    case drives::ValueKind::time:
      return positive;
  }
  throw RunError("read_history: a kind of value without a rule");
}
Reader reader_of(double& target, drives::ValueKind kind) {
  return into(target, unit_of_kind(kind), rule_of_kind(kind, false));
}
Reader reader_of(std::optional<double>& target, drives::ValueKind kind) {
  return into(target, unit_of_kind(kind), rule_of_kind(kind, false));
}
Reader reader_of(std::vector<double>& target, drives::ValueKind kind) {
  return into(target, unit_of_kind(kind), rule_of_kind(kind, true));
}
Reader reader_of(std::optional<std::int64_t>& target, drives::ValueKind) { return into(target, 1, most_number); }
Reader reader_of(bool& target, drives::ValueKind) { return into(target); }
/// @}

/// A key of one or more drives.
struct DriveKey {
  Key key;
  std::vector<std::string> drives, required_by;
};

/// One description of each drive.
template <class Any>
struct EachOf;
template <class... Spec>
struct EachOf<std::variant<Spec...>> {
  std::tuple<Spec...> specs;
  template <class F>
  void visit(F&& f) {
    std::apply([&](Spec&... spec) { (f(spec), ...); }, specs);
  }
};

/// Returns the keys of all drives. A key that several drives have is one key, which sets the value of all of them.
std::vector<DriveKey> keys_of_drives(EachOf<AnySpec>& drives) {
  std::vector<DriveKey> out;
  drives.visit([&]<class Spec>(Spec& spec) {
    spec.each_key(
        [&](const char* name, auto& member, drives::ValueKind kind, drives::ValueNeed need, const char* text) {
          Reader read = reader_of(member, kind);
          auto known = std::find_if(out.begin(), out.end(), [&](const DriveKey& k) { return k.key.name == name; });
          if (known == out.end()) {
            out.push_back({{name, Need::optional, std::move(read), "", ""}, {}, {}});
            known = out.end() - 1;
          } else {
            known->key.read.read = [first = known->key.read.read, second = std::move(read.read)](const Value& value) {
              first(value), second(value);
            };
          }
          known->drives.emplace_back(Spec::name);
          if (need == drives::ValueNeed::required) known->required_by.emplace_back(Spec::name);
          known->key.text += fmt::format("{}drive {}: {}", known->key.text.empty() ? "" : "; ", Spec::name, text);
        });
  });
  for (DriveKey& k : out) {
    if (!k.required_by.empty()) {
      k.key.read.words.usual.clear();
      k.key.usual = fmt::format("required by drive {}", fmt::join(k.required_by, ", "));
    } else if (k.key.read.words.usual.empty()) {
      k.key.usual = k.key.read.words.type.starts_with("list") ? "none" : "until the end of the test";
    }
  }
  return out;
}

/// Reads the columns time_s and strain of a table with commas. Other columns are ignored, as are lines that begin with
/// `#`, so that a history.csv of another run can be read.
class HistoryFile {
 public:
  explicit HistoryFile(const std::filesystem::path& file) : name_(file.string()), text_(read_whole(file)) {}

  void read(TableSpec& table) {
    std::size_t time = 0, strain = 0;
    bool has_head = false;
    for (std::string_view line; next(line);) {
      if (line.empty() || line.front() == '#') continue;
      const std::vector<std::string_view> cells = split(line);
      if (!has_head) {
        time = column(cells, "time_s"), strain = column(cells, "strain");
        has_head = true;
        continue;
      }
      table.times.push_back(number(cells, time, "time_s", non_negative));
      table.strains.push_back(number(cells, strain, "strain", any_strain));
      if (static_cast<double>(table.times.size()) > drives::most_pieces)
        throw InputError(name_, line_, "rows", "more than 1000000", "at most 1000000");
      require_order(table);
    }
    if (table.times.empty())
      throw InputError(name_, 0, "rows", "none", "columns time_s and strain, and a row for each time");
  }

 private:
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = std::string_view(text_).substr(at_, end - at_);
    if (line_ == 0 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // spreadsheets' byte-order mark
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1, ++line_;
    return true;
  }
  static std::string_view trimmed(std::string_view cell) {
    while (cell.starts_with(' ')) cell.remove_prefix(1);
    while (cell.ends_with(' ')) cell.remove_suffix(1);
    return cell;
  }
  static std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> out;
    for (std::size_t comma = 0; comma != std::string_view::npos; line.remove_prefix(std::min(comma + 1, line.size()))) {
      comma = line.find(',');
      out.push_back(trimmed(line.substr(0, comma)));
    }
    return out;
  }
  std::size_t column(const std::vector<std::string_view>& head, std::string_view name) const {
    const auto found = std::find(head.begin(), head.end(), name);
    if (found == head.end())
      throw InputError(name_, line_, "columns", fmt::format("{}", fmt::join(head, ",")), "columns time_s and strain");
    return static_cast<std::size_t>(found - head.begin());
  }
  double number(const std::vector<std::string_view>& cells, std::size_t k, const char* name, const Rule& rule) const {
    if (k >= cells.size())
      throw InputError(name_, line_, name, fmt::format("{} cells", cells.size()), fmt::format("at least {}", k + 1));
    double out = 0;
    const std::string_view cell = cells[k];
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), out);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(out) || !rule.holds(out))
      throw InputError(name_, line_, name, cell.empty() ? "nothing" : std::string(cell), rule.words);
    return out;
  }
  void require_order(const TableSpec& table) const {
    const std::size_t n = table.times.size();
    if (n == 1 && table.times[0] == 0 && table.strains[0] != 0)
      throw InputError(name_, line_, "strain", fmt::format("{}", table.strains[0]),
                       "0 at time 0, when the test begins");
    if (n > 1 && !(table.times[n - 1] > table.times[n - 2]))
      throw InputError(name_, line_, "time_s", fmt::format("{} after {}", table.times[n - 1], table.times[n - 2]),
                       "times that ascend");
  }

  std::string name_, text_;
  std::size_t at_ = 0;
  int line_ = 0;
};

/// Reads the table in the file that a scene names. Relative paths start from the scene's folder.
void read_file(const Section& section, const Value& value, TableSpec& table) {
  namespace fs = std::filesystem;
  const fs::path file = (fs::path(section.file()).parent_path() / value.text()).lexically_normal();
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    value.refuse("no file " + file.string(),
                 "a table with the columns time_s and strain; paths are relative to the scene's folder");
  }
  HistoryFile(file).read(table);
}

/// Checks that the scene has the keys of its drive and no others.
void check_keys(const Section& section, const std::vector<DriveKey>& keys, const std::string& drive) {
  std::vector<std::string> own;
  for (const DriveKey& k : keys)
    if (std::count(k.drives.begin(), k.drives.end(), drive)) own.push_back(k.key.name);
  for (const DriveKey& k : keys) {
    const std::string& name = k.key.name;
    const bool fits = std::count(own.begin(), own.end(), name) > 0;
    if (!fits && section.has(name)) {
      section.refuse(name, fmt::format("this key with drive = \"{}\"", drive),
                     fmt::format("only the keys of this drive: {}", fmt::join(own, ", ")));
    }
    if (std::count(k.required_by.begin(), k.required_by.end(), drive) && !section.has(name))
      section.refuse(name, "nothing", fmt::format("this key, which drive = \"{}\" requires", drive));
  }
  if (drive != TableSpec::name) {
    if (section.has("file"))
      section.refuse("file", fmt::format("this key with drive = \"{}\"", drive),
                     fmt::format("only the keys of this drive: {}", fmt::join(own, ", ")));
    return;
  }
  for (const std::string& name : own) {
    if (section.has("file") && section.has(name))
      section.refuse(name, "this key together with the key file", "only one of the two");
    if (!section.has("file") && !section.has(name))
      section.refuse(name, "nothing", "this key, or the key file, which drive = \"table\" requires");
  }
}

}  // namespace
}  // namespace scene

using experiments::StrainHistory;

template <>
StrainHistory ExperimentOf<StrainHistory>::read(const scene::Section& section) {
  using namespace scene;
  StrainHistory out;
  EachOf<AnySpec> drives;
  std::vector<std::pair<std::string, std::size_t>> names;
  drives.visit([&]<class Spec>(const Spec&) { names.emplace_back(Spec::name, names.size()); });
  std::size_t chosen = names.size();
  constexpr int fewest = 1, most = 1'000'000;
  const std::vector<DriveKey> drive_keys = keys_of_drives(drives);
  std::vector<Key> keys{
      kind_key(),
      {"drive", Need::required, into<std::size_t>(chosen, names), "how the strain changes in time"},
      {"duration", Need::required, into(out.duration, scene::duration, positive), "duration of the test"},
      {"samples", Need::optional, into(out.samples, fewest, most),
       "number of evenly spaced times at which strain and stress are recorded"},
      poisson_key(out.poisson_ratio),
      temperature_key(out.temperature)};
  keys[2].read.words.usual.clear();
  for (const DriveKey& k : drive_keys) keys.push_back(k.key);
  keys.push_back({"file",
                  Need::optional,
                  {[&](const Value& value) { read_file(section, value, std::get<TableSpec>(drives.specs)); }, {"text"}},
                  "drive table: CSV file with the columns time_s and strain, in place of times and strains",
                  "none"});
  section.read(keys);
  const std::string& drive = names[chosen].first;
  check_keys(section, drive_keys, drive);
  drives.visit([&]<class Spec>(const Spec& spec) {
    if (drive != Spec::name) return;
    const auto fault = spec.fault(out.duration);
    if (fault) section.refuse(section.has("file") ? "file" : fault->key, fault->found, fault->expected);
    const drives::StrainRange range = spec.range(out.duration);
    for (const double strain : {range.lowest, range.highest}) {
      if (!any_strain.holds(strain))
        section.refuse("duration", fmt::format("a strain of {:g} within the test", strain), any_strain.words);
    }
    out.drive = spec;
  });
  return out;
}

}  // namespace macadam
