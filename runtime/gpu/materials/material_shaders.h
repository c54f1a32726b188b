// Shaders of the game's material functions and motions of vertices: those of the renderer, compiled with
// them.
// "Material functions" in runtime/c/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/base/result.h"
#include "formats/gpu_shared/shading.h"
#include "formats/pack/pack_view.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hearth::gpu
{

/// Module of a shader, with the functions in it.
struct MaterialModule
{
    std::string_view
        name; ///< of the file of the renderer's own shader, with its variant: "shading_sampled.frag"
    std::span<const uint32_t> words;
};

/// Functions and motions of a game and their shaders, which outlive the renderer. Function i has the number
/// i + 1, and so has motion i.
struct MaterialShaders
{
    std::vector<std::string_view> functions;
    std::vector<std::string_view> motions;
    std::vector<MaterialModule> modules;
    std::string_view version; ///< of the shaders' sources: shaders::kSourcesVersion
};

/// Check that the shaders fit the renderer. errors: usage, saying what to do.
Status checkMaterialShaders(const MaterialShaders& shaders);

/// Return the words of a module. errors: usage, if the game has not compiled it; the message says how.
Result<std::span<const uint32_t>> findModule(const MaterialShaders& shaders, std::string_view name);

/// Function and motion of a material, and their parameters.
struct MaterialBinding
{
    uint32_t function = 0;  ///< 0: none
    uint32_t motion = 0;    ///< 0: none
    float motion_bound = 0; ///< metres in object space: no vertex moves farther
    std::array<Float4, shared::kMaterialParameters> parameters{};
};

/// Read the extras of all materials. "hearth_material" is the name of a function, "hearth_motion" that of a
/// motion, and "hearth_motion_bound" its bound, above 0. "hearth_parameters" is an array of up to four
/// numbers for each parameter, 0 where it ends.
/// shaders  of the game; or null: no material has a function, whatever its extras say
/// errors: usage, naming the material, if there is no such function or motion, or a number is none.
Result<std::vector<MaterialBinding>> bindMaterials(const formats::PackView& pack,
                                                   const MaterialShaders* shaders);

} // namespace hearth::gpu
