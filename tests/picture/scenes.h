// Registry of the scenes whose pictures are compared, and of the settings in which Hearth draws them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <string_view>

namespace hearth::picture
{

enum class Source
{
    sample, ///< kind of hearth-samples
    asset,  ///< file in the folder of real assets
};

enum class View
{
    fit,   ///< all of the scene, as hearth-render frames the default pack
    first, ///< the source's first camera
};

struct Scene
{
    std::string_view name;
    Source source;
    std::string_view path; ///< kind of sample, or file
    View view;
    unsigned samples = 1; ///< times those of other scenes: light that arrives over many bounces is noisy
};

/// All scenes. Nothing of Hearth is tuned on those of the assets.
inline constexpr std::array kScenes = {
    Scene{"spheres", Source::sample, "spheres", View::first},
    Scene{"shoe", Source::asset, "pbr-external/variants_shoe/MaterialsVariantsShoe.gltf", View::fit},
    Scene{"barrel", Source::asset, "tex-webp/barrel_webp/barrel_webp.glb", View::fit},
    Scene{"emissive", Source::asset, "emissive-strength/emission_strength/14_emission_strength.gltf",
          View::fit},
    Scene{"fox", Source::asset, "quantized/fox_quantized/fox_quantized.glb", View::fit},
    Scene{"foliage", Source::asset, "alpha/foliage_cards_b/foliage_cards_b.glb", View::fit},
    Scene{"outdoor", Source::sample, "outdoor", View::first, 4},
    Scene{"terrain", Source::asset, "scene/terrain_lowpoly/terrain.glb", View::fit},
    Scene{"cornell", Source::asset, "scene/cornell_babylon/cornellBox.glb", View::first, 8},
    Scene{"room", Source::sample, "room", View::first, 16},
    Scene{"demo", Source::sample, "scene", View::first, 2},
};

/// Settings of Hearth. `open`: nothing occludes; `plain`: no options are given; `full`: everything is baked
/// and on.
enum class Setting
{
    open,
    plain,
    full,
};

inline constexpr std::array kSettings = {Setting::open, Setting::plain, Setting::full};

constexpr std::string_view settingName(Setting setting)
{
    constexpr std::array kNames = {std::string_view("nothing occludes"), std::string_view("default"),
                                   std::string_view("all on")};
    return kNames[static_cast<size_t>(setting)];
}

/// Size of all pictures, in pixels.
inline constexpr unsigned kWidth = 640;
inline constexpr unsigned kHeight = 360;

/// References have so many pixels for one, in each direction: Hearth applies its tone curve to each of four
/// samples.
inline constexpr unsigned kOversampling = 2;

} // namespace hearth::picture
