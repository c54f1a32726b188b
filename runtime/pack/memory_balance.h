// Decides how much of one memory budget pages of geometry and mips of textures get while a scene runs,
// from the error scales of both. See runtime/pack/README.md, "One budget".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::pack
{

/// Memory that moves between both sides, in granules.
struct MemoryRange
{
    uint64_t total_bytes = 0;    ///< of both sides, without what is always resident
    uint64_t fixed_bytes = 0;    ///< of geometry, that it never gives
    uint64_t granule_bytes = 0;  ///< > 0
    uint32_t granules = 0;       ///< that move: geometry has 0 .. granules of them
    uint32_t start_granules = 0; ///< that geometry has at first
};

/// State of one side in a round.
struct MemoryDemand
{
    float error_scale = 1;     ///< >= 1
    uint64_t wanted_bytes = 0; ///< at this scale, of what is not always resident
};

/// Search for the share of geometry at which neither side is worse off. A side is worse off if its
/// error scale is more than kTolerance times the other's, or if it is above 1 while the other's is 1.
///
/// Once that holds for kRounds rounds in which the scales come no nearer to each other, the other side
/// gives as much as would make both scales equal if bytes fell with the square of the scale, and at
/// least twice the step before. Each decision bounds the search: geometry was worse off with so many
/// granules, textures with so many. So it ends for constant demand, after at most 2 * granules + 3
/// moves. A bound that an earlier view set may be wrong: before the search ends at it, it is tried once
/// more. The search begins anew when both sides have been even for as long without any change, or when
/// a demand changes after it has ended.
class MemoryBalance
{
public:
    static constexpr float kTolerance = 1.25f;
    static constexpr uint32_t kRounds = 32;
    static constexpr float kSteady = 1.125f; ///< scales that change by less are at rest

    explicit MemoryBalance(const MemoryRange& range);

    /// Take the demands of a round in which no memory is on its way; return the granules that geometry
    /// should have.
    uint32_t update(const MemoryDemand& geometry, const MemoryDemand& textures);

    /// Return the granules that geometry should have.
    uint32_t share() const { return share_; }

    /// Let geometry have no more than this from now on: the device has no memory for more.
    void limit(uint32_t granules);

    /// True if the scales as they are lead to no move.
    bool atRest() const { return worse_ == Side::none || has_ended_; }

private:
    enum class Side : uint8_t
    {
        none,
        geometry,
        textures,
    };
    static Side findWorse(float geometry_scale, float texture_scale);
    bool hasPersisted(float geometry_scale, float texture_scale);
    void forgetBounds();
    void decide(const MemoryDemand& geometry, const MemoryDemand& textures);
    uint64_t betterBytes(int64_t share) const;
    uint32_t estimate(float geometry_scale, float texture_scale) const;

    MemoryRange range_;
    uint32_t share_;
    Side worse_ = Side::none;                      ///< in the last round
    float geometry_scale_ = 1, texture_scale_ = 1; ///< since when rounds are counted
    uint32_t rounds_ =
        0; ///< in which the same side has been worse off, and the scales came no nearer to each other

    // bounds of the search: geometry was worse off with low_ granules, textures with high_
    int64_t low_ = -1, high_ = 0;
    int64_t step_ = 1;                             ///< of the last decision, at least
    Side last_worse_ = Side::none;                 ///< when it was made
    bool has_retried_ = false;                     ///< a bound has been tried once more
    bool has_ended_ = false;                       ///< no share is better
    MemoryDemand ended_geometry_, ended_textures_; ///< when it ended
};

} // namespace hearth::pack
