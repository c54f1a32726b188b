// Contents of a glTF 2.0 file before it is written: objects refer to each other by index, as in the
// file. Names and defaults are those of the specification; kInvalidIndex means an absent index.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::gltf_export
{

/// Component type, with OpenGL's numbers, as in the file.
enum class ComponentType : int
{
    u8 = 5121,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126,
};

enum class ElementType
{
    scalar,
    vec2,
    vec3,
    vec4,
    mat4,
};

/// Use of a view's bytes by a renderer, with OpenGL's numbers.
enum class ViewTarget : int
{
    none = 0,
    vertices = 34962,
    indices = 34963,
};

struct BufferView
{
    uint64_t offset = 0;
    uint64_t size = 0;
    ViewTarget target = ViewTarget::none;
};

struct Accessor
{
    uint32_t view = kInvalidIndex; ///< none: all elements are 0
    ComponentType component = ComponentType::f32;
    ElementType type = ElementType::scalar;
    bool is_normalized = false;
    uint64_t count = 0;
    std::vector<double> min; ///< of each component; empty: not stated
    std::vector<double> max;
};

struct Image
{
    std::string name;
    uint32_t view = kInvalidIndex; ///< bytes of a PNG file
};

/// Sampler and image; filters and wraps with OpenGL's numbers.
struct Texture
{
    uint32_t image = kInvalidIndex;
    int mag_filter = 0;
    int min_filter = 0;
    int wrap_s = 0;
    int wrap_t = 0;
    friend bool operator==(const Texture&, const Texture&) = default;
};

/// KHR_texture_transform.
struct TextureTransform
{
    std::array<double, 2> offset{0, 0};
    double rotation = 0;
    std::array<double, 2> scale{1, 1};
};

struct TextureUse
{
    uint32_t texture = kInvalidIndex; ///< none: the material has no such texture
    uint32_t uv_set = 0;
    std::optional<TextureTransform> transform;
};

/// KHR_materials_specular.
struct Specular
{
    double factor = 1;
    std::array<double, 3> color{1, 1, 1};
    TextureUse texture;
    TextureUse color_texture;
};

/// KHR_materials_clearcoat.
struct Clearcoat
{
    double factor = 0;
    double roughness = 0;
    double normal_scale = 1;
    TextureUse texture;
    TextureUse roughness_texture;
    TextureUse normal_texture;
};

/// KHR_materials_sheen.
struct Sheen
{
    std::array<double, 3> color{0, 0, 0};
    double roughness = 0;
    TextureUse color_texture;
    TextureUse roughness_texture;
};

struct Material
{
    std::string name;
    std::array<double, 4> base_color{1, 1, 1, 1};
    double metallic = 1;
    double roughness = 1;
    double normal_scale = 1;
    double occlusion_strength = 1;
    std::array<double, 3> emissive{0, 0, 0};
    double emissive_strength = 1;
    std::string alpha_mode = "OPAQUE";
    double alpha_cutoff = 0.5;
    bool is_double_sided = false;
    bool is_unlit = false;
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;
    TextureUse normal_texture;
    TextureUse occlusion_texture;
    TextureUse emissive_texture;
    std::optional<double> ior;
    std::optional<Specular> specular;
    std::optional<Clearcoat> clearcoat;
    std::optional<Sheen> sheen;
};

/// Accessors by the name of the attribute.
using Attributes = std::map<std::string, uint32_t>;

struct Primitive
{
    Attributes attributes;
    std::vector<Attributes> targets;
    uint32_t indices = kInvalidIndex;
    uint32_t material = kInvalidIndex;
};

struct Mesh
{
    std::string name;
    std::vector<Primitive> primitives;
};

struct Node
{
    std::string name;
    std::vector<uint32_t> children;
    uint32_t mesh = kInvalidIndex;
    uint32_t skin = kInvalidIndex;
    uint32_t camera = kInvalidIndex;
    uint32_t light = kInvalidIndex; ///< KHR_lights_punctual
    std::array<double, 3> translation{0, 0, 0};
    std::array<double, 4> rotation{0, 0, 0, 1};
    std::array<double, 3> scale{1, 1, 1};
    std::optional<std::array<double, 16>> matrix; ///< column-major, instead of the three above
    std::vector<double> weights;
    std::vector<uint32_t> lods; ///< MSFT_lod: nodes with less and less detail
};

struct Camera
{
    std::string name;
    bool is_orthographic = false;
    double y_fov = 0;
    double aspect = 0; ///< 0: not stated
    double x_magnification = 0;
    double y_magnification = 0;
    double z_near = 0;
    double z_far = 0; ///< 0: infinite
};

/// Light of KHR_lights_punctual.
struct Light
{
    std::string name;
    std::string type;
    std::array<double, 3> color{1, 1, 1};
    double intensity = 1;
    double range = 0; ///< 0: unlimited
    double inner_cone = 0;
    double outer_cone = 0;
};

struct Skin
{
    std::string name;
    std::vector<uint32_t> joints;
    uint32_t inverse_bind_matrices = kInvalidIndex;
    uint32_t skeleton = kInvalidIndex;
};

struct AnimationChannel
{
    uint32_t input = kInvalidIndex;
    uint32_t output = kInvalidIndex;
    std::string interpolation;
    uint32_t node = kInvalidIndex; ///< none: the path is a JSON pointer, KHR_animation_pointer
    std::string path;
};

struct Animation
{
    std::string name;
    std::vector<AnimationChannel> channels;
};

/// Extras of an object: JSON text, and the JSON pointer of the object in the file.
struct Extras
{
    std::string owner;
    std::string json;
};

struct GltfDocument
{
    std::string generator;
    std::vector<unsigned char> binary;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<uint32_t> scene_nodes;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Extras> extras;
};

} // namespace hearth::gltf_export
