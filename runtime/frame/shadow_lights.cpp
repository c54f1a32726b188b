// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_lights.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/light_cells.h"
#include "formats/gpu_shared/record_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace hearth::shared
{

namespace
{

constexpr uint32_t kNewRow = kNoShadow; // of a light that has just been chosen

uint32_t countRows(uint32_t type)
{
    return type == kLightPoint ? kPointFaces : 1;
}

/// Rows in use, one bit each.
class Rows
{
public:
    void take(const ShadowLights::Holder& holder) { used_ |= mask(holder.row, countRows(holder.type)); }

    /// Return free rows for a light. Point lights begin at multiples of six from the front, others come from
    /// the back, so that sixes stay together.
    std::optional<uint32_t> find(uint32_t type) const
    {
        if (countRows(type) == 1)
            return used_ == ~uint64_t{0} ? std::nullopt
                                         : std::optional<uint32_t>(63 - std::countl_one(used_));
        for (uint32_t row = 0; row + kPointFaces <= kMaxShadowProjections; row += kPointFaces)
            if ((used_ & mask(row, kPointFaces)) == 0)
                return row;
        return std::nullopt;
    }

private:
    static uint64_t mask(uint32_t row, uint32_t count) { return ((uint64_t{1} << count) - 1) << row; }

    static_assert(kMaxShadowProjections == 64);
    uint64_t used_ = 0;
};

/// Give rows to the lights that have none; false if there is none for one of them.
bool fillRows(std::span<ShadowLights::Holder> holders)
{
    Rows rows;
    for (const ShadowLights::Holder& holder : holders)
        if (holder.row != kNewRow)
            rows.take(holder);
    for (ShadowLights::Holder& holder : holders)
    {
        if (holder.row != kNewRow)
            continue;
        const std::optional<uint32_t> row = rows.find(holder.type);
        if (!row)
            return false;
        holder.row = *row;
        rows.take(holder);
    }
    return true;
}

const ShadowLights::Holder* findSlot(std::span<const ShadowLights::Holder> holders, uint32_t slot)
{
    const auto found = std::find_if(holders.begin(), holders.end(),
                                    [&](const ShadowLights::Holder& holder) { return holder.slot == slot; });
    return found == holders.end() ? nullptr : &*found;
}

} // namespace

uint32_t countShadowRows(const Light& light)
{
    return countRows(light.type);
}

float shadowWeight(const Light& light, float luminance, Float3 eye)
{
    constexpr float kPi = std::numbers::pi_v<float>;
    if (light.type == kLightDirectional)
        return std::numeric_limits<float>::infinity();
    const float distance = length(light.position - eye);
    if (light.range <= 0 || distance <= light.range)
        return luminance * 4 * kPi;
    const float sine = light.range / distance;
    const float sine2 = sine * sine;
    // 1 - cos, without the cancellation at small angles
    return luminance * 2 * kPi * (sine2 / (1 + std::sqrt(1 - sine2)));
}

bool ShadowLights::isBefore(const Candidate& a, const Candidate& b)
{
    if (a.weight != b.weight)
        return a.weight > b.weight;
    return a.holds != b.holds ? a.holds : a.slot < b.slot;
}

ShadowLights::ShadowLights(uint32_t max_lights)
{
    holders_.reserve(kMaxShadowProjections);
    last_.reserve(kMaxShadowProjections);
    changes_.reserve(2 * kMaxShadowProjections);
    candidates_.reserve(max_lights);
}

/// List the lights that are on, by falling weight.
void ShadowLights::rank(std::span<const Light> lights, std::span<const float> luminances, Float3 eye)
{
    candidates_.clear();
    for (uint32_t slot = 0; slot < lights.size(); ++slot)
        if (luminances[slot] > 0)
            candidates_.push_back({shadowWeight(lights[slot], luminances[slot], eye), false, slot});
    for (const Holder& holder : holders_)
    {
        const auto found =
            std::lower_bound(candidates_.begin(), candidates_.end(), holder.slot,
                             [](const Candidate& candidate, uint32_t slot) { return candidate.slot < slot; });
        if (found != candidates_.end() && found->slot == holder.slot &&
            lights[holder.slot].type == holder.type)
        {
            found->holds = true;
            found->weight *= kShadowHysteresis;
        }
    }
    std::sort(candidates_.begin(), candidates_.end(), isBefore);
}

void ShadowLights::choose(std::span<const Light> lights, std::span<const float> luminances, Float3 eye,
                          const ShadowBudget& budget)
{
    HEARTH_ASSERT(luminances.size() == lights.size());
    rank(lights, luminances, eye);
    last_.swap(holders_);
    holders_.clear();
    dropped_maps_ = 0;
    uint32_t rows_left = kMaxShadowProjections;
    uint32_t maps_left = budget.maps;
    uint32_t unlimited_rows_left = kMaxShadowProjections; // with any number of maps
    for (const Candidate& candidate : candidates_)
    {
        const uint32_t type = lights[candidate.slot].type;
        const uint32_t rows = countRows(type);
        const bool is_sun = type == kLightDirectional;
        const uint32_t maps = is_sun ? budget.maps_of_a_sun : rows;
        const bool fits = rows <= rows_left && (is_sun ? 1 : maps) <= maps_left;
        if (rows <= unlimited_rows_left)
        {
            unlimited_rows_left -= rows;
            dropped_maps_ += fits ? 0 : maps;
        }
        if (!fits)
            continue;
        rows_left -= rows;
        maps_left -= std::min(maps, maps_left);
        const Holder* const held = candidate.holds ? findSlot(last_, candidate.slot) : nullptr;
        holders_.push_back({candidate.slot, type, held == nullptr ? kNewRow : held->row});
    }
    placeRows();
    findChanges(last_);
}

void ShadowLights::placeRows()
{
    if (fillRows(holders_))
        return;
    for (Holder& holder : holders_)
        holder.row = kNewRow;
    const bool fits = fillRows(holders_);
    HEARTH_ASSERT(fits); // sixes from the front and single rows from the back meet at the last row
}

void ShadowLights::findChanges(std::span<const Holder> before)
{
    changes_.clear();
    for (const Holder& holder : before)
        if (findSlot(holders_, holder.slot) == nullptr)
            changes_.push_back({holder.slot, kNoShadow});
    for (const Holder& holder : holders_)
    {
        const Holder* const last = findSlot(before, holder.slot);
        if (last == nullptr || last->row != holder.row)
            changes_.push_back({holder.slot, holder.row});
    }
}

} // namespace hearth::shared
