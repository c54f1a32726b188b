// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/memory_balance.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::pack
{

namespace
{

/// True if a side's demand is another than before. A scale that still rises is no sign of that, nor are
/// the fewer bytes that it leaves.
bool hasChanged(const MemoryDemand& now, const MemoryDemand& before)
{
    constexpr float kFactor = MemoryBalance::kTolerance;
    const auto bytes = static_cast<float>(now.wanted_bytes),
               bytes_before = static_cast<float>(before.wanted_bytes);
    return now.error_scale * kFactor < before.error_scale || bytes > bytes_before * kFactor ||
           (bytes * kFactor < bytes_before && now.error_scale <= before.error_scale);
}

} // namespace

MemoryBalance::MemoryBalance(const MemoryRange& range) : range_(range), share_(range.start_granules)
{
    HEARTH_ASSERT(range.granule_bytes > 0 && share_ <= range.granules);
    forgetBounds();
}

void MemoryBalance::forgetBounds()
{
    low_ = -1;
    high_ = int64_t{range_.granules} + 1;
    has_retried_ = has_ended_ = false;
    last_worse_ = Side::none;
}

MemoryBalance::Side MemoryBalance::findWorse(float geometry_scale, float texture_scale)
{
    const auto isWorse = [](float scale, float other)
    { return scale > kTolerance * other || (scale > 1 && other <= 1); };
    return isWorse(geometry_scale, texture_scale)   ? Side::geometry
           : isWorse(texture_scale, geometry_scale) ? Side::textures
                                                    : Side::none;
}

uint32_t MemoryBalance::update(const MemoryDemand& geometry, const MemoryDemand& textures)
{
    if (has_ended_ && (hasChanged(geometry, ended_geometry_) || hasChanged(textures, ended_textures_)))
        forgetBounds();
    if (hasPersisted(geometry.error_scale, textures.error_scale))
    {
        if (worse_ == Side::none)
            forgetBounds();
        else if (!has_ended_)
            decide(geometry, textures);
    }
    return share_;
}

/// Count a round; return true once the same side has been worse off for kRounds of them, and begin
/// again. Its scale must not fall in them, nor the other's rise: while they still come nearer to each
/// other, a share seems other than it is.
bool MemoryBalance::hasPersisted(float geometry_scale, float texture_scale)
{
    const Side worse = findWorse(geometry_scale, texture_scale);
    const auto hasRisen = [](float scale, float before) { return scale > before * kSteady; };
    bool is_same = worse == worse_;
    if (worse == Side::none)
        is_same = is_same && geometry_scale == geometry_scale_ && texture_scale == texture_scale_;
    else if (worse == Side::geometry)
        is_same =
            is_same && !hasRisen(geometry_scale_, geometry_scale) && !hasRisen(texture_scale, texture_scale_);
    else
        is_same =
            is_same && !hasRisen(texture_scale_, texture_scale) && !hasRisen(geometry_scale, geometry_scale_);
    worse_ = worse;
    if (is_same && ++rounds_ < kRounds)
        return false;
    rounds_ = 0;
    geometry_scale_ = geometry_scale;
    texture_scale_ = texture_scale;
    return is_same;
}

/// Bound the search by the present share, and choose the next between the bounds.
void MemoryBalance::decide(const MemoryDemand& geometry, const MemoryDemand& textures)
{
    const int64_t end = int64_t{range_.granules} + 1;
    int64_t& bound = worse_ == Side::geometry ? low_ : high_;
    int64_t& other = worse_ == Side::geometry ? high_ : low_;
    const int64_t other_end = worse_ == Side::geometry ? end : -1;
    bound = share_;
    if (low_ >= high_) // the other bound is of an earlier demand
        other = other_end;
    const MemoryDemand& better = worse_ == Side::geometry ? textures : geometry;
    if (other != other_end && better.error_scale <= 1 && better.wanted_bytes <= betterBytes(other))
    {
        // so is this one: the other side would have all that it wants there
        other = other_end;
        has_retried_ = false;
    }
    if (high_ - low_ == 1 && other != other_end && !has_retried_)
    {
        has_retried_ = true;
        share_ = static_cast<uint32_t>(other);
        other = other_end;
        return;
    }
    if (high_ - low_ == 1)
    {
        has_ended_ = true;
        ended_geometry_ = geometry;
        ended_textures_ = textures;
        return;
    }
    // lumps in a demand hide how much is missing: step twice as far each time, but half-way to a known
    // bound
    step_ = worse_ == last_worse_ ? 2 * step_ : 1;
    last_worse_ = worse_;
    const int64_t room = worse_ == Side::geometry ? high_ - share_ : share_ - low_;
    const int64_t step = other == other_end ? step_ : std::min(step_, room / 2);
    const int64_t best = estimate(geometry.error_scale, textures.error_scale);
    const int64_t next =
        worse_ == Side::geometry ? std::max(best, share_ + step) : std::min(best, share_ - step);
    share_ = static_cast<uint32_t>(std::clamp(next, low_ + 1, high_ - 1));
}

/// Return the bytes that the side which is better off has at a share.
uint64_t MemoryBalance::betterBytes(int64_t share) const
{
    const uint64_t geometry = range_.fixed_bytes + static_cast<uint64_t>(share) * range_.granule_bytes;
    return worse_ == Side::geometry ? range_.total_bytes - geometry : geometry;
}

/// Return the granules of geometry that make both scales equal, if bytes fall with the square of the
/// scale.
uint32_t MemoryBalance::estimate(float geometry_scale, float texture_scale) const
{
    const uint64_t geometry_bytes = range_.fixed_bytes + share_ * range_.granule_bytes;
    const double total = static_cast<double>(range_.total_bytes);
    const double wanted_pages = static_cast<double>(geometry_bytes) * geometry_scale * geometry_scale;
    const double wanted_texels =
        (total - static_cast<double>(geometry_bytes)) * texture_scale * texture_scale;
    const double bytes = total * wanted_pages / std::max(wanted_pages + wanted_texels, 1.0);
    const double moving = std::max(bytes - static_cast<double>(range_.fixed_bytes), 0.0);
    return static_cast<uint32_t>(std::min(moving / static_cast<double>(range_.granule_bytes) + 0.5,
                                          static_cast<double>(range_.granules)));
}

void MemoryBalance::limit(uint32_t granules)
{
    range_.granules = std::min(range_.granules, granules);
    share_ = std::min(share_, range_.granules);
    forgetBounds();
}

} // namespace hearth::pack
