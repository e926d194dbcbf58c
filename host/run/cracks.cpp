// SPDX-License-Identifier: GPL-3.0-or-later
// cracks.cpp  Records and counts broken contact points, and determines whether intact contacts still join the walls.
#include "host/run/cracks.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "host/base/disjoint_sets.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam {

using experiments::CrackEvent;
using experiments::Cracks;
using experiments::PairCracks;

namespace {

/// Number of contacts in a piece of parallel work.
constexpr std::size_t contacts_at_once = 1024;

/// Sums over the cracks of some contacts, by pair type.
struct PieceSums {
  std::array<std::int64_t, pair_types> cracked{};
  std::array<double, pair_types> cracked_area_m2{};
  double crack_energy_j = 0, friction_energy_j = 0;

  PieceSums& operator+=(const PieceSums& other) {
    for (std::size_t i = 0; i < pair_types; ++i)
      cracked[i] += other.cracked[i], cracked_area_m2[i] += other.cracked_area_m2[i];
    crack_energy_j += other.crack_energy_j, friction_energy_j += other.friction_energy_j;
    return *this;
  }
};

/// Returns a whole number with thousands separators: 12,345.
std::string grouped(std::int64_t number) {
  std::string out = fmt::format("{}", number);
  for (std::ptrdiff_t at = std::ssize(out) - 3; at > 0; at -= 3) out.insert(static_cast<std::size_t>(at), ",");
  return out;
}

std::string of_breakable(const Cracks& cracks) {
  std::string out = fmt::format("{} of {} contact points that can break are broken", grouped(cracks.points()),
                                grouped(cracks.breakable()));
  if (cracks.sums) out += fmt::format("; {} have begun to crack", grouped(cracks.sums->cracked));
  return out;
}

}  // namespace

bool counts_cracks(const Scene& scene) { return is_stepped(scene.solver.method) && can_break(facts_of(scene.laws)); }

void read_contact_state(const Scene& scene, const Stepper& stepper, const ContactNetwork& network, ContactState& out) {
  const bool only_points =
      scene.solver.backend == Backend::reference || scene.solver.method == SolverMethod::quasi_static;
  if (!only_points) return stepper.read_contacts(network, out);
  out.point_breaks = stepper.point_breaks(network);
  out.point_cracks = stepper.point_cracks(network);
}

CrackWatch::CrackWatch(const Scene& scene, const Preparation& prepared, const std::vector<CrackEvent>& before)
    : network_(prepared.network),
      laws_(facts_of(scene.laws)),
      active_(can_break(laws_)),
      joined_at_start_(prepared.spanning_clusters > 0) {
  if (!active_) return;
  if (can_crack(laws_)) found_.sums.emplace();
  broken_.resize(network_.point_area.size(), false);
  links_.reserve(network_.contacts.size());
  for (const Contact& c : network_.contacts) {
    links_.push_back({c.a, c.b, c.point_end - c.point_begin});
    const auto pair = static_cast<std::size_t>(c.pair);
    if (laws_[pair] && laws_[pair]->breaks) found_.by_pair[pair].breakable += c.point_end - c.point_begin;
  }
  for (const CrackEvent& event : before) {
    const bool known =
        event.contact < network_.contacts.size() && event.point < broken_.size() && !broken_[event.point];
    if (!known || (event.how != Break::tension && event.how != Break::shear)) {
      throw InputError(fmt::format(
          "checkpoint: found a break of point {} of contact {}, expected a point of the specimen that can break",
          event.point, event.contact));
    }
    add(event);
  }
}

void CrackWatch::add(const CrackEvent& event) {
  PairCracks& pair = found_.by_pair[static_cast<std::size_t>(network_.contacts[event.contact].pair)];
  ++pair.points;
  ++(event.how == Break::tension ? pair.tension : pair.shear);
  pair.area_m2 += network_.point_area[event.point];
  if (!pair.first_s) pair.first_s = event.time_s;
  broken_[event.point] = true;
  --links_[event.contact].intact;
  found_.events.push_back(event);
}

std::vector<CrackEvent> CrackWatch::look(const ContactState& state, double time) {
  std::vector<CrackEvent> out;
  if (!active_) return out;
  const std::size_t contacts = network_.contacts.size();
  std::vector<std::vector<CrackEvent>> pieces((contacts + contacts_at_once - 1) / contacts_at_once);
  for_pieces(contacts, contacts_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t c = from; c < to; ++c) {
      const Contact& contact = network_.contacts[c];
      for (std::uint32_t point = contact.point_begin; point < contact.point_end; ++point) {
        if (state.point_breaks[point] == Break::none || broken_[point]) continue;
        CrackEvent event{static_cast<std::uint32_t>(c), point, state.point_breaks[point], time};
        if (sums()) event.opening_m = state.point_cracks[point].opening, event.slip_m = state.point_cracks[point].slip;
        pieces[from / contacts_at_once].push_back(event);
      }
    }
  });
  for (const std::vector<CrackEvent>& piece : pieces) out.insert(out.end(), piece.begin(), piece.end());
  for (const CrackEvent& event : out) add(event);
  if (sums()) sum(state.point_cracks);
  return out;
}

std::vector<CrackEvent> CrackWatch::look(const experiments::CrackSurvey& survey, double time) {
  std::vector<CrackEvent> out;
  for (CrackEvent event : survey.broken) {
    if (broken_[event.point]) continue;
    event.time_s = time;
    out.push_back(event);
    add(event);
  }
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    found_.by_pair[pair].cracked = survey.cracked[pair];
    found_.by_pair[pair].cracked_area_m2 = survey.sums.cracked_area_m2[pair];
  }
  found_.sums = survey.sums;
  return out;
}

void CrackWatch::sum(const std::vector<laws::PointCrack>& cracks) {
  const auto all =
      sum_of_pieces<PieceSums>(network_.contacts.size(), contacts_at_once, [&](std::size_t from, std::size_t to) {
        PieceSums piece;
        for (std::size_t c = from; c < to; ++c) {
          const Contact& contact = network_.contacts[c];
          const auto pair = static_cast<std::size_t>(contact.pair);
          for (std::uint32_t point = contact.point_begin; point < contact.point_end; ++point) {
            const double area = network_.point_area[point];
            if (cracks[point].damage > 0) ++piece.cracked[pair], piece.cracked_area_m2[pair] += area;
            piece.crack_energy_j += cracks[point].energy * area;
            piece.friction_energy_j += cracks[point].friction * area;
          }
        }
        return piece;
      });
  experiments::CrackSums now;
  now.crack_energy_j = all.crack_energy_j, now.friction_energy_j = all.friction_energy_j;
  for (std::size_t i = 0; i < pair_types; ++i) {
    found_.by_pair[i].cracked = all.cracked[i], found_.by_pair[i].cracked_area_m2 = all.cracked_area_m2[i];
    now.cracked += all.cracked[i];
    now.cracked_area_m2[i] = all.cracked_area_m2[i];
  }
  found_.sums = now;
}

bool CrackWatch::joins_walls() const {
  if (of_first_rank(static_cast<double>(found_.points())) == 0 || !joined_at_start_) return true;
  const auto top = static_cast<std::int32_t>(network_.row_begin.size() - 1), held = top + 1;
  DisjointSets sets(static_cast<std::size_t>(held) + 1);
  for (const Link& link : links_) {
    if (link.intact > 0) sets.join(link.a, link.b >= 0 ? link.b : link.b == wall_z_hi ? top : held);
  }
  return of_first_rank(sets.find(top) == sets.find(held)) != 0;
}

std::string crack_head(bool openings) {
  return fmt::format("contact,a,b,pair,x,y,z,nx,ny,nz,area_m2,mode,{}time_s",
                     openings ? "opening_m,slip_m,damage," : "");
}

std::string crack_line(const Preparation& prepared, const CrackEvent& event, bool openings) {
  const ContactNetwork& network = prepared.network;
  const Contact& c = network.contacts[event.contact];
  const Vec3d x = prepared.specimen.centre[static_cast<std::size_t>(c.a)] + c.arm_a * c.n +
                  network.point_s[event.point] * c.s + network.point_t[event.point] * c.t;
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}{}", event.contact, c.a, c.b, to_string(c.pair), x.x, x.y,
                     x.z, c.n.x, c.n.y, c.n.z, network.point_area[event.point], to_string(event.how),
                     openings ? fmt::format("{},{},1,", event.opening_m, event.slip_m) : "", event.time_s);
}

std::vector<double> to_numbers(const std::vector<CrackEvent>& events) {
  std::vector<double> out;
  for (const CrackEvent& e : events) {
    out.insert(out.end(), {static_cast<double>(e.contact), static_cast<double>(e.point), static_cast<double>(e.how),
                           e.time_s, e.opening_m, e.slip_m});
  }
  return out;
}

std::vector<CrackEvent> to_cracks(const std::vector<double>& numbers) {
  constexpr std::size_t words = 6;
  if (numbers.size() % words != 0) {
    throw InputError(
        fmt::format("checkpoint: found a list of {} numbers for broken points, expected a multiple of {} numbers",
                    numbers.size(), words));
  }
  std::vector<CrackEvent> out;
  for (std::size_t i = 0; i < numbers.size(); i += words) {
    const auto whole = [&](std::size_t k, double largest) {
      const double number = numbers[i + k];
      if (!(number >= 0 && number <= largest)) {
        throw InputError(
            fmt::format("checkpoint: found the number {} in the list of broken points, expected a number from 0 to {}",
                        number, largest));
      }
      return static_cast<std::uint32_t>(number);
    };
    constexpr double largest = std::numeric_limits<std::uint32_t>::max();
    out.push_back({whole(0, largest), whole(1, largest),
                   static_cast<Break>(whole(2, static_cast<double>(Break::shear))), numbers[i + 3], numbers[i + 4],
                   numbers[i + 5]});
  }
  return out;
}

nlohmann::ordered_json cracks_json(const Cracks& cracks) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < pair_types; ++i) {
    const PairCracks& pair = cracks.by_pair[i];
    if (pair.breakable == 0) continue;
    nlohmann::ordered_json& entry = out[to_string(static_cast<PairType>(i))];
    entry = {{"points", pair.points},
             {"area_m2", pair.area_m2},
             {"tension", pair.tension},
             {"shear", pair.shear},
             {"breakable_points", pair.breakable},
             {"first_s", pair.first_s ? nlohmann::ordered_json(*pair.first_s) : nlohmann::ordered_json()}};
    if (!cracks.sums) continue;
    entry["cracked_points"] = pair.cracked;
    entry["cracked_area_m2"] = pair.cracked_area_m2;
  }
  return out;
}

nlohmann::ordered_json rupture_json(const experiments::Rupture& r) {
  return {{"time_s", r.time_s},
          {"strain", r.strain},
          {"time_before_s", r.time_before_s},
          {"strain_before", r.strain_before},
          {"words", rupture_words(r)}};
}

std::string rupture_words(const experiments::Rupture& r) {
  return fmt::format(
      "The specimen broke between t = {:.4g} s and {:.4g} s (strain {:.4g} to {:.4g}): no intact contact path joins "
      "the bottom and the top wall, and the test ends there.",
      r.time_before_s, r.time_s, r.strain_before, r.strain);
}

std::string cracks_words(const Cracks& cracks) {
  std::string out = of_breakable(cracks);
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i < pair_types; ++i) {
    const PairCracks& pair = cracks.by_pair[i];
    if (pair.points == 0) continue;
    pairs.push_back(fmt::format("{} {} ({} in tension, {} in shear)", to_string(static_cast<PairType>(i)),
                                grouped(pair.points), grouped(pair.tension), grouped(pair.shear)));
  }
  return pairs.empty() ? out : fmt::format("{}: {}", out, fmt::join(pairs, ", "));
}

}  // namespace macadam
