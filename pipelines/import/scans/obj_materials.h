// Reads the materials of OBJ files: MTL, the "Material Library File" appendix of the Advanced Visualizer
// manual.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/scans/scan_polygons.h"

#include <map>

namespace hearth::import
{

/// Texture statement with its supported options. MTL counts v from the bottom up: uv' = uv * scale + offset.
struct MtlTexture
{
    std::string file;
    Float2 scale{1, 1};
    Float2 offset{0, 0};
    bool clamp = false;
    float bump_multiplier = 1;
};

struct MtlMaterial
{
    Float3 diffuse{0.8f, 0.8f, 0.8f}; ///< Kd; default: the grey of modelling programs
    Float3 emissive{0, 0, 0};         ///< Ke
    float opacity = 1;                ///< d, or 1 - Tr
    float shininess = 0;              ///< Ns, a Phong exponent
    bool has_diffuse = false;
    bool has_shininess = false;
    MtlTexture diffuse_map;      ///< map_Kd
    MtlTexture emissive_map;     ///< map_Ke
    MtlTexture normal_map;       ///< norm, or map_Bump if it is no height map
    MtlTexture opacity_map;      ///< map_d
    bool normal_is_bump = false; ///< normal_map came from map_Bump
};

struct MtlLibrary
{
    std::map<std::string, MtlMaterial, std::less<>> materials;
    std::vector<ScanNote> notes;
};

/// Read a material library. `name` is used in the notes. Damaged statements are skipped with a note: a scan
/// is worth reading even without its materials.
void readMtl(std::string_view text, const std::string& name, MtlLibrary& library);

/// Return the microfacet roughness whose highlight is as wide as the highlight of a Phong exponent.
float roughnessFromShininess(float shininess);

struct ScanMaterialIndices
{
    std::vector<uint32_t> by_name;    ///< for each of ScanPolygons::material_names, a material of the part
    formats::MaterialRecord fallback; ///< for faces without a material; not in the part yet
};

/// Return the material of a scan without materials: white, rough and without textures.
formats::MaterialRecord defaultScanMaterial();

/// Add the materials that the scan uses, with their images, to the part; all files come from the asset's
/// folder. A missing file is a warning. errors: cannot_write.
Result<ScanMaterialIndices> addScanMaterials(const ScanPolygons& scan, const std::string& path,
                                             const ImportOptions& options, PartBuilder& part);

} // namespace hearth::import
