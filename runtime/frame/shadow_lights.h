// Chooses the lights of a frame that have shadow maps, and their rows of the ShadowBlock: more lights cast
// shadows than there is memory for. C++ only. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::shared
{

/// Factor by which the weight of a light must exceed that of a light with shadow maps to take its place.
/// Without it, lights of about equal weight would take turns while the eye moves, and their shadows pop.
inline constexpr float kShadowHysteresis = 1.25f;

/// Return the number of rows, and of maps without spheres, of a light; a sun has one row, and any number of
/// maps.
uint32_t countShadowRows(const Light& light);

/// Return the weight by which lights are ranked: luminance x solid angle of the ball of the light's range
/// from the eye, which is 4 pi inside of the ball and without a range. Suns, infinite, come first.
///
/// luminance  of the light's intensity, without flicker: a flame that flickers keeps its shadow
float shadowWeight(const Light& light, float luminance, Float3 eye);

/// Maps that lights may have.
struct ShadowBudget
{
    uint32_t maps = 0;          ///< of all lights
    uint32_t maps_of_a_sun = 1; ///< a sun takes fewer if there are not as many left
};

/// Change of a light's row.
struct ShadowRowChange
{
    uint32_t slot = 0;        ///< of the light
    uint32_t row = kNoShadow; ///< new row, or kNoShadow
};

/// Lights with shadow maps, from frame to frame. Lights take part as a whole: a point light has six rows and
/// six maps, or none. A light that has maps keeps them until others with kShadowHysteresis times its weight
/// need their place. Rows move only where those left over are no six neighbours; maps do not follow rows.
class ShadowLights
{
public:
    /// max_lights  slots; choices allocate nothing
    explicit ShadowLights(uint32_t max_lights);

    /// Choose the lights of the next frame.
    ///
    /// lights      slots; a light that is no longer of the same type takes part as a new one
    /// luminances  [lights.size()] of intensities without flicker; 0: the light is off
    void choose(std::span<const Light> lights, std::span<const float> luminances, Float3 eye,
                const ShadowBudget& budget);

    /// Lights of the last choice.
    struct Holder
    {
        uint32_t slot = 0;
        uint32_t type = 0; ///< kLight*
        uint32_t row = 0;  ///< first row in the ShadowBlock
    };
    std::span<const Holder> holders() const { return holders_; } ///< by falling weight
    std::span<const ShadowRowChange> changes() const { return changes_; }
    uint32_t lightsOn() const { return static_cast<uint32_t>(candidates_.size()); }
    /// Maps for which ShadowBudget::maps is too small, of lights for which there would be rows.
    uint32_t droppedMaps() const { return dropped_maps_; }

private:
    struct Candidate
    {
        float weight;
        bool holds;
        uint32_t slot;
    };
    static bool isBefore(const Candidate& a, const Candidate& b);
    void rank(std::span<const Light> lights, std::span<const float> luminances, Float3 eye);
    void placeRows();
    void findChanges(std::span<const Holder> before);

    std::vector<Holder> holders_;
    std::vector<Holder> last_;
    std::vector<ShadowRowChange> changes_;
    std::vector<Candidate> candidates_;
    uint32_t dropped_maps_ = 0;
};

} // namespace hearth::shared
