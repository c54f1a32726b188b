// Converts KHR_materials_pbrSpecularGlossiness to metallic-roughness, by the conversion that Khronos
// published with the extension: solve for the metalness that gives the same diffuse and specular brightness.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/model.h"

namespace hearth::import
{

/// Linear colours.
struct SpecularGlossiness
{
    Float3 diffuse;
    Float3 specular;
    float glossiness = 1;
};

struct MetallicRoughness
{
    Float3 base_color;
    float metallic = 0;
    float roughness = 1;
};

MetallicRoughness convertSpecularGlossiness(const SpecularGlossiness& source);

/// Base colour (sRGB, with the diffuse texture's alpha) and metallic-roughness textures, each of the size of
/// the larger source image.
struct MetallicRoughnessImages
{
    DecodedImage base_color;
    DecodedImage metallic_roughness;
};

/// Convert every texel; an empty source image counts as white. 8-bit images only (asserted).
MetallicRoughnessImages convertSpecularGlossiness(const GltfSpecularGlossiness& factors,
                                                  const DecodedImage& diffuse,
                                                  const DecodedImage& specular_glossiness);

} // namespace hearth::import
