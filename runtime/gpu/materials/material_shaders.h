// Shaders of the game's material functions: shading of the renderer, compiled with the functions in it.
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

/// Functions of a game and their shaders, which outlive the renderer. Function i has the number i + 1.
struct MaterialShaders
{
    std::vector<std::string_view> functions;
    std::vector<MaterialModule> modules;
    std::string_view version; ///< of the shaders' sources: shaders::kSourcesVersion
};

/// Check that the shaders fit the renderer. errors: usage, saying what to do.
Status checkMaterialShaders(const MaterialShaders& shaders);

/// Return the words of a module. errors: usage, if the game has not compiled it; the message says how.
Result<std::span<const uint32_t>> findModule(const MaterialShaders& shaders, std::string_view name);

/// Function of a material and its parameters.
struct MaterialBinding
{
    uint32_t function = 0; ///< 0: none
    std::array<Float4, shared::kMaterialParameters> parameters{};
};

/// Read the extras of a material: "hearth_material" is the name of a function, "hearth_parameters" an array
/// of up to four numbers for each parameter, 0 where it ends.
/// functions  of the game; empty: no material has a function, whatever its extras say
/// errors: usage, naming the material, if there is no such function, or the parameters are no such array.
Result<MaterialBinding> bindMaterial(const formats::PackView& pack, uint32_t material,
                                     std::span<const std::string_view> functions);

} // namespace hearth::gpu
