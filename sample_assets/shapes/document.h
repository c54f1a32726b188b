// Minimal model of a glTF document, produced by the generators and written by the GLB writer. Plain data;
// indices refer to the arrays of Document. sample_assets/README.md has the order in which to read this
// folder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::samples
{

/// "None" in every index of a document.
inline constexpr int kNoIndex = -1;

/// A triangle mesh with one material. An attribute array is empty or as long as `positions`.
struct TriangleMesh
{
    std::vector<Float3> positions; ///< metres
    std::vector<Float3> normals;   ///< unit
    std::vector<Float2> uvs;
    std::vector<Float4> colors; ///< linear RGBA
    std::vector<std::array<uint16_t, 4>> joints;
    std::vector<Float4> weights; ///< sum 1
    std::vector<uint32_t> indices;
};

/// RGBA8, rows top to bottom. Colour images hold sRGB values, all others plain data.
struct Image
{
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> texels; ///< width * height * 4
};

struct Material
{
    std::string name;
    Float4 base_color{1, 1, 1, 1};
    Float3 emissive{0, 0, 0};    ///< 0..1
    float emissive_strength = 1; ///< KHR_materials_emissive_strength where it is not 1
    float metallic = 0;
    float roughness = 1;
    float normal_scale = 1;
    float alpha_cutoff = 0; ///< above 0: alpha mode MASK
    float detail_scale = 1; ///< KHR_texture_transform of the normal texture where it is not 1
    bool double_sided = false;
    bool unlit = false; ///< KHR_materials_unlit: base colour is shown unlit
    int base_color_image = kNoIndex;
    int metallic_roughness_image = kNoIndex; ///< G roughness, B metallic; also R occlusion if has_occlusion
    int normal_image = kNoIndex;
    int emissive_image = kNoIndex;
    bool has_occlusion = false;
};

struct Primitive
{
    TriangleMesh mesh;
    int material = kNoIndex;
};

struct Mesh
{
    std::string name;
    std::vector<Primitive> primitives;
};

/// Unit quaternion x y z w.
struct Placement
{
    Float3 translation{0, 0, 0};
    Float4 rotation{0, 0, 0, 1};
    Float3 scale{1, 1, 1};
};

struct Node
{
    std::string name;
    Placement placement;
    std::vector<int> children;
    int mesh = kNoIndex;
    int skin = kNoIndex;
    int camera = kNoIndex;
    int light = kNoIndex;
    std::vector<Placement> instances; ///< EXT_mesh_gpu_instancing of `mesh`
};

struct Camera
{
    std::string name;
    float y_fov_rad = 0.8f;
    float z_near = 0.05f;
    float z_far = 0; ///< 0: infinite
};

enum class LightKind
{
    directional,
    point,
    spot,
};

/// Random change of a light's intensity over time, as of a flame; written as "flicker" of the light's extras.
struct Flicker
{
    float rate = 0;      ///< changes a second, Hz
    float amplitude = 0; ///< part of the intensity that is taken away at most, 0..1; 0: the light is steady
    uint32_t seed = 0;
};

struct Light
{
    std::string name;
    LightKind kind = LightKind::point;
    Float3 color{1, 1, 1};
    float intensity = 1; ///< lux if directional, else candela
    float range = 0;     ///< metres; 0: unlimited
    float inner_cone_rad = 0;
    float outer_cone_rad = 0.7853982f;
    Flicker flicker;
};

struct Skin
{
    std::string name;
    std::vector<int> joints;              ///< nodes
    std::vector<Affine3> joint_from_bind; ///< inverse bind matrices
    int skeleton_root = kNoIndex;
};

enum class TrackPath
{
    translation,
    rotation,
};

enum class TrackKind
{
    linear,
    cubic_spline,
    step,
};

/// Animation track. Values are x y z (w): one for each time, or in-tangent, value, out-tangent for a cubic
/// spline.
struct Track
{
    int node = kNoIndex;
    TrackPath path = TrackPath::rotation;
    TrackKind kind = TrackKind::linear;
    std::vector<float> times;
    std::vector<Float4> values;
};

enum class LightProperty
{
    intensity,
    color,
};

/// Animation track of a light, not of a node: a channel of KHR_animation_pointer.
struct LightTrack
{
    int light = kNoIndex;
    LightProperty property = LightProperty::intensity;
    TrackKind kind = TrackKind::linear; ///< linear or step
    std::vector<float> times;
    std::vector<Float3> values; ///< one for each time; of an intensity x alone
};

struct Animation
{
    std::string name;
    std::vector<Track> tracks;
    std::vector<LightTrack> light_tracks{};
};

struct Document
{
    std::vector<Image> images;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<int> roots; ///< nodes of the scene
};

/// Append `item` and return its index.
template <typename T>
int add(std::vector<T>& items, T item)
{
    items.push_back(std::move(item));
    return static_cast<int>(items.size()) - 1;
}

/// Append a node that is a root of the scene.
inline int addRoot(Document& document, Node node)
{
    const int index = add(document.nodes, std::move(node));
    document.roots.push_back(index);
    return index;
}

} // namespace hearth::samples
