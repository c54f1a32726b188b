// Contents of a glTF file, checked: every index is in range, every property has its type. Data of buffers are
// not included. Names and defaults are those of the glTF 2.0 specification; kInvalidIndex means an absent
// index. SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/material_layers.h"
#include "pipelines/import/gltf/document/json.h"
#include "pipelines/import/part/transform.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hearth::import
{

struct GltfBuffer
{
    std::optional<std::string> uri; ///< none: the BIN chunk of a GLB, or a fallback without data
    uint64_t byte_length = 0;
    bool fallback = false; ///< EXT_meshopt_compression: only compressed views refer to it
};

enum class MeshoptMode : uint32_t
{
    attributes,
    triangles,
    indices,
};

enum class MeshoptFilter : uint32_t
{
    none,
    octahedral,
    quaternion,
    exponential,
};

struct GltfMeshopt
{
    uint32_t buffer = kInvalidIndex;
    uint64_t byte_offset = 0;
    uint64_t byte_length = 0;
    uint64_t byte_stride = 0;
    uint64_t count = 0;
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
};

struct GltfBufferView
{
    uint32_t buffer = kInvalidIndex;
    uint64_t byte_offset = 0;
    uint64_t byte_length = 0;
    uint64_t byte_stride = 0; ///< 0: elements are contiguous
    std::optional<GltfMeshopt> meshopt;
};

/// Component type, with OpenGL's numbers, as in the file.
enum class ComponentType : uint32_t
{
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126,
};

enum class ElementType : uint32_t
{
    scalar,
    vec2,
    vec3,
    vec4,
    mat2,
    mat3,
    mat4,
};

struct GltfSparse
{
    uint64_t count = 0;
    uint32_t indices_view = kInvalidIndex;
    uint64_t indices_offset = 0;
    ComponentType indices_type = ComponentType::u16;
    uint32_t values_view = kInvalidIndex;
    uint64_t values_offset = 0;
};

struct GltfAccessor
{
    uint32_t buffer_view = kInvalidIndex; ///< none: all zero, before `sparse`
    uint64_t byte_offset = 0;
    ComponentType component = ComponentType::f32;
    ElementType type = ElementType::scalar;
    bool normalized = false;
    uint64_t count = 0;
    std::optional<GltfSparse> sparse;
};

struct GltfImage
{
    std::string name;
    std::optional<std::string> uri;
    uint32_t buffer_view = kInvalidIndex;
};

struct GltfTexture
{
    uint32_t image =
        kInvalidIndex; ///< of the property or an extension; none: a texture that nothing can show
    formats::Wrap wrap_u = formats::Wrap::repeat;
    formats::Wrap wrap_v = formats::Wrap::repeat;
    bool nearest = false;
};

/// Use of a texture by a material; `texture` is kInvalidIndex if there is none.
struct GltfTextureUse
{
    uint32_t texture = kInvalidIndex;
    uint32_t uv_set = 0;
    std::array<float, 6> uv_transform{1, 0, 0, 0, 1, 0}; ///< row-major 2x3
};

/// Factors and textures of KHR_materials_pbrSpecularGlossiness.
struct GltfSpecularGlossiness
{
    std::array<float, 4> diffuse{1, 1, 1, 1};
    std::array<float, 3> specular{1, 1, 1};
    float glossiness = 1;
    GltfTextureUse diffuse_texture;
    GltfTextureUse specular_glossiness_texture;
};

/// Factors and textures of KHR_materials_ior, _specular, _clearcoat and _sheen.
struct GltfLayers
{
    float ior = formats::kDefaultIor;
    float specular = 1;
    std::array<float, 3> specular_color{1, 1, 1};
    float clearcoat = 0;
    float clearcoat_roughness = 0;
    float clearcoat_normal_scale = 1;
    std::array<float, 3> sheen_color{0, 0, 0};
    float sheen_roughness = 0;
    GltfTextureUse specular_texture;            ///< A
    GltfTextureUse specular_color_texture;      ///< RGB
    GltfTextureUse clearcoat_texture;           ///< R
    GltfTextureUse clearcoat_roughness_texture; ///< G
    GltfTextureUse clearcoat_normal_texture;
    GltfTextureUse sheen_color_texture;     ///< RGB
    GltfTextureUse sheen_roughness_texture; ///< A

    std::array<const GltfTextureUse*, 7> textures() const
    {
        return {&specular_texture,         &specular_color_texture,
                &clearcoat_texture,        &clearcoat_roughness_texture,
                &clearcoat_normal_texture, &sheen_color_texture,
                &sheen_roughness_texture};
    }
};

struct GltfMaterial
{
    std::string name;
    std::array<float, 4> base_color{1, 1, 1, 1};
    float metallic = 1;
    float roughness = 1;
    float normal_scale = 1;
    float occlusion_strength = 1;
    std::array<float, 3> emissive{0, 0, 0};
    float emissive_strength = 1;
    formats::AlphaMode alpha_mode = formats::AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    GltfTextureUse base_color_texture;
    GltfTextureUse metallic_roughness_texture;
    GltfTextureUse normal_texture;
    GltfTextureUse occlusion_texture;
    GltfTextureUse emissive_texture;
    GltfLayers layers;
    std::optional<GltfSpecularGlossiness> specular_glossiness;
};

struct GltfAttribute
{
    std::string semantic; ///< "POSITION", "TEXCOORD_1", "_MINE"
    uint32_t accessor = kInvalidIndex;
    friend bool operator==(const GltfAttribute&, const GltfAttribute&) = default;
    friend auto operator<=>(const GltfAttribute&, const GltfAttribute&) = default;
};

/// Attributes in the order of their names, so that equal sets of attributes compare equal.
using GltfAttributes = std::vector<GltfAttribute>;

struct GltfDraco
{
    uint32_t buffer_view = kInvalidIndex;
    GltfAttributes attributes; ///< `accessor` is the id of the attribute in the compressed data
    friend bool operator==(const GltfDraco&, const GltfDraco&) = default;
    friend auto operator<=>(const GltfDraco&, const GltfDraco&) = default;
};

/// Primitive mode, with OpenGL's numbers.
enum class PrimitiveMode : uint32_t
{
    points = 0,
    lines = 1,
    line_loop = 2,
    line_strip = 3,
    triangles = 4,
    triangle_strip = 5,
    triangle_fan = 6,
};

struct GltfPrimitive
{
    GltfAttributes attributes;
    std::vector<GltfAttributes> targets;
    uint32_t indices = kInvalidIndex;
    uint32_t material = kInvalidIndex;
    PrimitiveMode mode = PrimitiveMode::triangles;
    std::optional<GltfDraco> draco;
};

/// Mark in the extras of a node or mesh, hearth_proxy: true, false or "convex".
enum class GltfProxyMark : uint8_t
{
    absent,
    none,   ///< false: no proxy, whatever its name
    proxy,  ///< true: stands for another mesh
    convex, ///< the same, as a convex part
};

struct GltfMesh
{
    std::string name;
    std::vector<GltfPrimitive> primitives;
    std::vector<float> weights;
    GltfProxyMark proxy = GltfProxyMark::absent;
};

/// Shadow sphere from the extras of a node: hearth_shadow_radius, hearth_shadow_light, hearth_shadow_texels.
struct GltfShadowSphere
{
    float radius = 1;    ///< in the node's space
    std::string light;   ///< name of a light or of its node; empty: all lights
    uint32_t texels = 0; ///< 0: the renderer's choice
};

struct GltfNode
{
    std::string name;
    std::vector<uint32_t> children;
    uint32_t parent = kInvalidIndex;
    uint32_t mesh = kInvalidIndex;
    uint32_t skin = kInvalidIndex;
    uint32_t camera = kInvalidIndex;
    uint32_t light = kInvalidIndex;
    bool has_trs = true;
    std::array<float, 3> translation{0, 0, 0};
    std::array<float, 4> rotation{0, 0, 0, 1};
    std::array<float, 3> scale{1, 1, 1};
    Transform parent_from_node;
    std::vector<float> weights;
    bool has_instancing = false;
    GltfAttributes instancing;  ///< EXT_mesh_gpu_instancing
    std::vector<uint32_t> lods; ///< MSFT_lod: nodes with less and less detail; all exist
    std::optional<GltfShadowSphere> shadow_sphere;
    GltfProxyMark proxy = GltfProxyMark::absent;
};

struct GltfScene
{
    std::string name;
    std::vector<uint32_t> nodes;
    uint32_t image_light = kInvalidIndex;
};

/// Light of EXT_lights_image_based.
struct GltfImageLight
{
    std::string name;
    float intensity = 1;
    std::array<float, 4> rotation{0, 0, 0, 1}; ///< unit
    uint32_t face_size = 1;
    std::vector<std::vector<uint32_t>> faces_of_mip; ///< images: +X, -X, +Y, -Y, +Z, -Z of each mip
};

struct GltfCamera
{
    std::string name;
    formats::CameraType type = formats::CameraType::perspective;
    float y_fov_rad = 0;
    float aspect = 0;
    float x_magnification = 0;
    float y_magnification = 0;
    float z_near = 0;
    float z_far = 0;
};

/// Flicker from the extras of a light: formats/scene/light_flicker.h.
struct GltfFlicker
{
    float rate = 0; ///< hertz; 0: none
    float amplitude = 0;
    uint32_t seed = 0;
};

struct GltfLight
{
    std::string name;
    formats::LightType type = formats::LightType::point;
    std::array<float, 3> color{1, 1, 1};
    float intensity = 1;
    float range = 0;
    float inner_cone_rad = 0;
    float outer_cone_rad = 0;
    GltfFlicker flicker;
};

struct GltfSkin
{
    std::string name;
    uint32_t inverse_bind_matrices = kInvalidIndex;
    uint32_t skeleton = kInvalidIndex;
    std::vector<uint32_t> joints;
};

struct GltfAnimationSampler
{
    uint32_t input = kInvalidIndex;
    uint32_t output = kInvalidIndex;
    formats::Interpolation interpolation = formats::Interpolation::linear;
};

struct GltfAnimationChannel
{
    uint32_t sampler = kInvalidIndex;
    uint32_t target = kInvalidIndex; ///< node, or light of the document
    formats::AnimationPath path = formats::AnimationPath::translation;
};

struct GltfAnimation
{
    std::string name;
    std::vector<GltfAnimationSampler> samplers;
    std::vector<GltfAnimationChannel> channels; ///< only those of nodes and punctual lights
};

struct GltfModel
{
    std::vector<GltfBuffer> buffers;
    std::vector<GltfBufferView> buffer_views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<GltfMaterial> materials;
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<GltfScene> scenes;
    uint32_t scene = kInvalidIndex;
    std::vector<GltfCamera> cameras;
    std::vector<GltfLight> lights;
    std::vector<GltfImageLight> image_lights;
    std::vector<GltfSkin> skins;
    std::vector<GltfAnimation> animations;
};

/// Read and check the whole document, used or not. Unsupported contents get a warning by name.
/// errors: gltf_structure, gltf_value, gltf_reference, gltf_version, gltf_extension, gltf_extension_value,
/// gltf_hierarchy, gltf_bounds, number_too_large.
Result<GltfModel> readGltfModel(const JsonDocument& document, const std::string& file, PartBuilder& part);

/// Return the scene that is drawn; kInvalidIndex: all nodes are.
uint32_t drawnScene(const GltfModel& model);

/// Return the number of components of an element: 1, 2, 3, 4, 4, 9, 16.
uint32_t componentCount(ElementType type);

/// Return the bytes of one component.
uint32_t componentSize(ComponentType type);

} // namespace hearth::import
