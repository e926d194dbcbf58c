// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_words.hpp  Defines the 16-byte words in which a tile on the GPU stores a contact. Only this file knows
/// what each word holds. docs/gpu-step.md shows how these words are used.
///
/// A contact of a tile has two arrays of 16-byte words, both in the order [packet][word][lane]: constants, which a step
/// only reads, and states, which it reads and writes. TileContactWords::pack() writes the constants before the first
/// step, begin() and settle() change some of them between two blocks of steps, and a step reads them through
/// ContactInBlock. To store one more number per contact, add a word to Constant or State, as docs/gpu-step.md
/// describes; the sizes of all arrays, copies to shared memory, checkpoints (settled_fields(), state_fields()) and
/// messages between ranks follow from this file.
#pragma once

#include <cuda_runtime.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "kernels/contact/contact_kinematics.hpp"
#include "kernels/contact/contact_data.hpp"
#include "kernels/layout/tile_plan.hpp"

namespace macadam::kernels {

/// Two 16-bit numbers in one word, for the ends A and B of a contact.
struct EndPair {
  std::uint32_t word;
  __host__ __device__ static constexpr EndPair of(std::uint16_t a, std::uint16_t b) {
    return {a | static_cast<std::uint32_t>(b) << 16};
  }
  __host__ __device__ constexpr std::uint32_t a() const { return word & 0xffff; }
  __host__ __device__ constexpr std::uint32_t b() const { return word >> 16; }
};

/// Two numbers of a contact in one word: its group (pair type) and its wall contact number, or no_wall.
struct GroupAndWallContact {
  static constexpr std::uint32_t group_bits = 4, no_wall = (1u << (32 - group_bits)) - 1;
  static_assert(pair_types <= 1 << group_bits);
  std::uint32_t word;
  __host__ __device__ static constexpr GroupAndWallContact of(std::uint32_t group, std::uint32_t wall_contact) {
    return {group | (wall_contact < no_wall ? wall_contact : no_wall) << group_bits};
  }
  __host__ __device__ constexpr std::uint32_t group() const { return word & ((1u << group_bits) - 1); }
  __host__ __device__ constexpr std::uint32_t wall_contact() const { return word >> group_bits; }
};

/// Which words and which arithmetic the contacts of a specimen need in tiles.
struct TileContent {
  bool carried;  ///< the words include frames: updated geometry, or `series`
  bool series;   ///< some contact has rock in series
};

/// Returns the content of the tiles of a run. With rock in series, contacts of fixed geometry have the words of updated
/// geometry too, because the factor of the rock is in one of these words.
inline TileContent tile_content(const ContactNetwork& network, const StepperOptions& options) {
  const bool series = std::ranges::any_of(network.contacts, [](const Contact& c) { return c.series != 0; });
  return {options.geometry == Geometry::updated || series, series};
}
template <bool carried, bool memory>
struct ContactInBlock;

/// The words of a contact: packs, updates and reads them. Its functions have two arguments: `carried`, whether the
/// words include the contact frame and the factor of rock in series (geometry updated during the run, or some contact
/// with rock in series), and `memory`, whether some law has a memory.
class TileContactWords {
  enum Constant {
    normal,    ///< normal n, lever arm of end A
    moment_a,  ///< lever arm of end B, area moments 0…2
    moment_b,  ///< area moments 3…5, EndPair of the local numbers of the bodies
    drift_b,   ///< drift of components 4 and 5, EndPair of the cells of loads, GroupAndWallContact
    drift_a,   ///< drift of components 0…3
    tangent,   ///< first tangent s, factor of rock in series in normal components (SeriesFactors); if `carried`
  };
  /// The first word of a state holds δf 0…3, the second δf 4, 5 and sum 0, 1, the third sum 2…5.
  enum State { change_a, change_b_sum_a, sum_b };
  template <bool carried, bool memory>
  friend struct ContactInBlock;

 public:
  /// Returns the number of words of constants per contact.
  __host__ __device__ static constexpr int constants(bool carried) { return carried ? tangent + 1 : tangent; }
  /// Returns how many of the words of constants a step reads; they are the first ones. With fixed geometry and without
  /// a law with a memory, a step does not read drift_a.
  __host__ __device__ static constexpr int constants_read(bool carried, bool memory) {
    return memory || carried ? constants(carried) : drift_a;
  }
  /// Number of words of states per contact, and number of these that a step reads and writes.
  static constexpr int states = sum_b + 1;
  __host__ __device__ static constexpr int states_moved(bool memory) { return memory ? states : sum_b; }

  /// Returns the address of the first word of the contact at `position`, in an array with `count` words per contact.
  /// The following words are 32 words apart.
  template <class Word>
  __host__ __device__ __forceinline__ static Word* at(Word* words, std::uint32_t position, int count) {
    return words + static_cast<std::size_t>(position / 32) * count * 32 + position % 32;
  }
  /// Returns the index of the first word of the contact at `position`, in an array with `count` words per contact.
  static std::size_t first(std::size_t position, int count) {
    return position / 32 * static_cast<std::size_t>(count) * 32 + position % 32;
  }

  /// Packs the constants of a contact. `word`(k): its geometry word k (GeometryWord).
  template <class Geometry>
  static void pack(float4* out, const TileContact& c, Geometry&& word) {
    out[normal * 32] = {word(n_x), word(n_y), word(n_z), word(arm_a)};
    out[moment_a * 32] = {word(arm_b), word(moment_0), word(moment_0 + 1), word(moment_0 + 2)};
    out[moment_b * 32] = {word(moment_0 + 3), word(moment_0 + 4), word(moment_0 + 5),
                          bits(EndPair::of(c.local_a, c.local_b).word)};
    out[drift_b * 32] = {0, 0, bits(EndPair::of(c.cell_a, c.cell_b).word),
                         bits(GroupAndWallContact::of(c.group, c.wall_contact).word)};
  }
  /// Packs an inert contact: its loads are not stored in any cell or under any wall contact number.
  static void pack_inert(float4* out, bool carried) {
    if (carried) out[tangent * 32].w = 1;
    out[drift_b * 32] = {0, 0, bits(UINT32_MAX), bits(GroupAndWallContact::of(0, GroupAndWallContact::no_wall).word)};
  }

  /// Sets the constants that change between blocks to their values for the undeformed contact, and the factor of rock
  /// in series. `word` as in pack().
  template <bool carried, class Geometry>
  __device__ __forceinline__ static void begin(float4* out, Geometry&& word, float series_factor) {
    out[drift_a * 32] = {0, 0, 0, 0};
    *reinterpret_cast<float2*>(out + drift_b * 32) = {0, 0};
    if constexpr (carried) {
      out[normal * 32] = {word(n_x), word(n_y), word(n_z), word(arm_a)};
      out[moment_a * 32].x = word(arm_b);
      out[tangent * 32] = {0, 0, 0, series_factor};
    }
  }
  /// Writes the constants of the next block: the drift and, if `carried`, the frame and the factor of rock in series.
  template <bool carried>
  __device__ __forceinline__ static void settle(float4* out, const Placement<double>& frame, const float (&drift)[6],
                                                float series_factor) {
    out[drift_a * 32] = {drift[0], drift[1], drift[2], drift[3]};
    *reinterpret_cast<float2*>(out + drift_b * 32) = {drift[4], drift[5]};
    if constexpr (carried) {
      out[normal * 32] = {float(frame.n.x), float(frame.n.y), float(frame.n.z), float(frame.arm_a)};
      out[moment_a * 32].x = float(frame.arm_b);
      out[tangent * 32] = {float(frame.s.x), float(frame.s.y), float(frame.s.z), series_factor};
    }
  }

  /// Reads the state of a contact. Only laws with a memory have sums; without one, `sum` is left unchanged.
  template <bool memory = true>
  __host__ __device__ __forceinline__ static void read_state(const float4* state, float (&change)[6], float (&sum)[6]) {
    const float4 a = state[change_a * 32], b = state[change_b_sum_a * 32];
    change[0] = a.x, change[1] = a.y, change[2] = a.z, change[3] = a.w, change[4] = b.x, change[5] = b.y;
    if constexpr (memory) {
      const float4 c = state[sum_b * 32];
      sum[0] = b.z, sum[1] = b.w, sum[2] = c.x, sum[3] = c.y, sum[4] = c.z, sum[5] = c.w;
    }
  }
  /// Sets the state before a step: zero if the step begins a block, else the state in memory.
  template <bool memory>
  __device__ __forceinline__ static void state_before(bool begins, const float4* state, float (&change)[6],
                                                      float (&sum)[6]) {
    if (!begins) return read_state<memory>(state, change, sum);
    for (int c = 0; c < 6; ++c) change[c] = sum[c] = 0;
  }
  /// Writes the state of a contact.
  template <bool memory>
  __device__ __forceinline__ static void write_state(float4* state, const float (&change)[6], const float (&sum)[6]) {
    state[change_a * 32] = {change[0], change[1], change[2], change[3]};
    if constexpr (memory) {
      state[change_b_sum_a * 32] = {change[4], change[5], sum[0], sum[1]};
      state[sum_b * 32] = {sum[2], sum[3], sum[4], sum[5]};
    } else {
      state[change_b_sum_a * 32] = {change[4], change[5], 0, 0};
    }
  }

  /// The first `components` components of one word.
  struct Field {
    int word, components;
  };
  /// Returns the constants that change between blocks, in the order in which a checkpoint stores them. The factor of
  /// rock in series is not one of them: begin() sets it.
  static std::vector<Field> settled_fields(bool carried) {
    std::vector<Field> out{{drift_a, 4}, {drift_b, 2}};
    if (carried) out.insert(out.end(), {{normal, 4}, {moment_a, 1}, {tangent, 3}});
    return out;
  }
  /// Returns the words of a contact's state.
  static std::vector<Field> state_fields() { return {{change_a, 4}, {change_b_sum_a, 4}, {sum_b, 4}}; }

 private:
  /// Returns a float with the bit pattern x, to store integers in words of floats.
  static float bits(std::uint32_t x) {
    float out = 0;
    std::memcpy(&out, &x, sizeof out);
    return out;
  }
};

/// The constants of one contact that a step reads, in registers.
template <bool carried, bool memory>
struct ContactConstants {
  static constexpr int words = TileContactWords::constants_read(carried, memory);
  float4 word[words];
  __device__ __forceinline__ void load(const float4* from) {
#pragma unroll
    for (int k = 0; k < words; ++k) word[k] = from[k * 32];
  }
};

/// One contact without its state: its constants unpacked, with its frame.
template <bool carried, bool memory>
struct ContactInBlock {
  using W = TileContactWords;
  const float4 (&word)[W::constants_read(carried, memory)];
  Placement<float> frame;
  GroupAndWallContact of;
  EndPair cells;

  __device__ __forceinline__ explicit ContactInBlock(const ContactConstants<carried, memory>& constant)
      : word(constant.word), of{__float_as_uint(word[W::drift_b].w)}, cells{__float_as_uint(word[W::drift_b].z)} {
    const float4 c0 = word[W::normal];
    const Vec3<float> n{c0.x, c0.y, c0.z};
    if constexpr (carried) {
      const float4 c5 = word[W::tangent];
      const Vec3<float> tangent{c5.x, c5.y, c5.z};
      frame = {n, tangent, cross(n, tangent), c0.w, word[W::moment_a].x};
    } else {
      frame = canonical_placement(n, copysignf(1.0f, n.z), c0.w, word[W::moment_a].x);
    }
  }
  /// Returns the local numbers of the two bodies.
  __device__ __forceinline__ EndPair ends() const { return {__float_as_uint(word[W::moment_b].w)}; }

  /// Returns the factor of rock in series in normal components; only if `carried`.
  __device__ __forceinline__ float series_factor() const { return word[W::tangent].w; }

  /// Reads the drift of the six components; only if some law has a memory.
  __device__ __forceinline__ void read_drift(float (&drift)[6]) const {
    const float4 c3 = word[W::drift_a], c4 = word[W::drift_b];
    drift[0] = c3.x, drift[1] = c3.y, drift[2] = c3.z, drift[3] = c3.w, drift[4] = c4.x, drift[5] = c4.y;
  }

  /// Returns the change of the contact's loads that belongs to the change `change` of its force density f.
  __device__ __forceinline__ ContactLoad<float> load(const float (&change)[6], float alpha) const {
    const float4 c1 = word[W::moment_a], c2 = word[W::moment_b];
    const float moments[6] = {c1.y, c1.z, c1.w, c2.x, c2.y, c2.z};
    return to_centres(frame, condensed_load(change, alpha, moments));
  }
};

}  // namespace macadam::kernels
