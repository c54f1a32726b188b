// Collects what import reads, mesh by mesh and image by image, and writes the import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/compress.h"
#include "cook/mesh/source_mesh.h"
#include "cook/proxy/surface/binding.h"
#include "cook/proxy/surface/proxy_tables.h"
#include "cook/tools/lod_files.h"
#include "formats/container/container_writer.h"
#include "formats/records/extras.h"
#include "formats/records/material_layers.h"
#include "formats/records/probe.h"
#include "formats/records/scene.h"
#include "pipelines/import/part/source_sky.h"
#include "pipelines/import/part/vertex_bounds.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// Share of the mesh's diagonal below which distances need not be told apart: proxies of artists lie off
/// their meshes, as wraps do, where finer bounds take seconds.
inline constexpr double kEnoughProxyDistance = 5e-3;

/// Number type of an image's channels.
enum class ChannelType : uint8_t
{
    unorm8,  ///< as stored in the file
    unorm16, ///< as stored in the file
    float16, ///< linear
};

/// Transfer function of an image's colours, as its file says it. The use of an image decides how it is read.
enum class Transfer : uint8_t
{
    unsaid,
    linear,
    srgb,
};

/// Loss in an image's decoding, for a warning by the image's user.
struct ImageNote
{
    Issue issue;
    std::string text;
};

/// Decoded image: rows top to bottom, four channels, tightly packed.
struct DecodedImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    ChannelType type = ChannelType::unorm8;
    std::vector<std::byte> texels; ///< width * height * texelBytes()
    std::vector<ImageNote> notes{};
    Transfer transfer = Transfer::unsaid;

    bool isFloat() const { return type == ChannelType::float16; }
    size_t channelBytes() const { return type == ChannelType::unorm8 ? 1 : 2; }
    size_t texelBytes() const { return 4 * channelBytes(); }
};

/// Counts of the source in its own terms, for the report.
struct SourceCounts
{
    uint64_t triangles = 0; ///< over meshes, not instances
    uint64_t faces = 0;     ///< polygons before triangulation
    uint64_t vertices = 0;  ///< glTF: over the distinct POSITION accessors; scans: vertices of the file
    uint64_t materials = 0;
    uint64_t joints = 0; ///< distinct joint nodes
    uint64_t animations = 0;
    uint64_t morph_targets = 0;
};

/// Truncate the texts of an error to a readable length: names in a hostile file can be megabytes long.
Error truncateTexts(Error error);

/// Import part being written. Small records collect in the public vectors. Meshes and images go to the file
/// immediately, so that only one mesh and one image are in memory at a time.
class PartBuilder
{
public:
    static Result<PartBuilder> create(const std::string& path, std::string source_name);

    /// Add a name to the string table and return its reference; equal names share it.
    formats::StringRef intern(std::string_view text);

    /// Return a text of the string table.
    std::string_view text(formats::StringRef ref) const
    {
        return std::string_view(strings_).substr(ref.offset, ref.length);
    }

    /// Write the next mesh; meshes get the indices 0, 1, ... in call order.
    Status addMesh(const mesh::SourceMesh& mesh);

    /// Write a mesh that is the next coarser level of detail of mesh `of`, in the object space of `of` and
    /// moved by the same joints. The level has a mesh index of its own. `label` is the level's number and
    /// name in the source.
    Status addLod(uint32_t of, const mesh::SourceMesh& mesh, const tools::LodLabel& label);

    /// Write the next image (finest mip only) and return its index. `record` provides name and flags; of its
    /// format only counts if it is one of colours (sRGB).
    Result<uint32_t> addImage(formats::ImageRecord record, const DecodedImage& image);

    /// Write the only probe of the part.
    Status addProbe(const formats::ProbeRecord& probe, std::span<const uint32_t> texels);

    /// Add a warning for the user; the program prints it to stderr and META stores it.
    void warn(Issue issue, std::string where, std::string detail);
    /// Add a warning with a remark, which follows the detail on stderr only. A remark may depend on more than
    /// the files that are read, such as names of neighbouring files, but the part must not.
    void warn(Issue issue, std::string where, std::string detail, std::string_view remark);

    /// Warn of an image of colours that has 16 bits a channel: its mips have 8.
    /// name  of the image in the message: "image \"bark.png\" of material \"oak\""
    void warnOfColorDepth(const DecodedImage& image, const std::string& where, const std::string& name);

    /// Warn of an image whose file says another transfer function than its use asks for.
    /// are_colors  the use: sRGB; false: numbers as they are
    /// name        as above
    void warnOfTransfer(const DecodedImage& image, bool are_colors, const std::string& where,
                        const std::string& name);

    /// Register a source file that was read: name relative to the asset's folder, and content for the hash.
    void addSource(std::string name, std::span<const std::byte> content);
    /// Register a source file that is not in memory at once; `hash` is from formats::hashBytes.
    void addSource(std::string name, uint64_t size, uint64_t hash);

    Status finish();

    std::vector<formats::NodeRecord> nodes;
    std::vector<formats::InstanceRecord> instances;
    std::vector<formats::CameraRecord> cameras;
    std::vector<formats::LightRecord> lights;
    std::vector<formats::ShadowSphereRecord> shadow_spheres;
    std::vector<formats::MaterialRecord> materials;
    std::vector<formats::MaterialLayersRecord> material_layers; ///< sorted by material
    std::vector<formats::ExtrasRecord> extras; ///< sorted; of asset, scene and file with index 0
    std::vector<formats::SkinRecord> skins;
    std::vector<formats::JointRecord> joints;
    std::vector<formats::AnimationRecord> animations;
    std::vector<formats::AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<uint32_t> key_bits;
    std::vector<float> morph_weights;
    std::vector<animation_compression::ClipStatistics>
        clip_statistics;        ///< of compressed animations, for the report
    proxy::ProxyTables proxies; ///< that an artist made
    proxy::SharedDistances proxy_distances{kEnoughProxyDistance};
    SourceCounts counts;
    std::optional<SourceSky> sky; ///< for writeSky

    const std::string& sourceName() const { return source_name_; }
    uint32_t imageCount() const { return static_cast<uint32_t>(images_.size()); }
    /// Bounds of the moved vertices of a mesh and its levels of detail.
    const VertexBounds& vertexBounds(uint32_t mesh) const { return vertex_bounds_[mesh]; }
    bool hasLods() const { return !lods_.empty(); }

    /// Add the sources and messages of another part, whose meshes become part of this one.
    void mergeReport(const PartBuilder& other);

    /// Return the warnings as shown to the user, with their remarks.
    std::vector<Error> warnings() const;

    /// Number of messages beyond the first hundred, which are counted but not stored.
    uint64_t omittedWarningCount() const { return omitted_warning_count_; }

    /// Return the text of chunk META, schema hearth.import/1.
    std::string report() const;

    /// Return the statistics of the import for --stats: report(), and litBox() as "lit_box".
    std::string statistics() const;

    /// Return the box in world space of what may occlude and be occluded: all instances at rest, without
    /// deformed meshes and meshes whose materials are all unlit. Empty if there are none.
    Box3 litBox() const;

private:
    PartBuilder(formats::ContainerWriter writer, std::string source_name);

    struct SourceFile
    {
        std::string name;
        uint64_t size = 0;
        uint64_t hash = 0;
    };

    struct Warning
    {
        Error error;
        std::string remark;
    };

    formats::ContainerWriter writer_;
    std::string source_name_;
    std::string strings_;
    std::map<std::string, formats::StringRef, std::less<>> string_refs_;
    std::vector<formats::ImageRecord> images_;
    uint32_t mesh_count_ = 0;
    std::vector<formats::AuthoredLodRecord> lods_;
    std::vector<VertexBounds> vertex_bounds_;              ///< for each mesh
    std::vector<std::vector<uint32_t>> materials_of_mesh_; ///< distinct; kInvalidIndex: the default
    std::vector<Warning> warnings_;
    uint64_t omitted_warning_count_ = 0;
    std::vector<SourceFile> sources_;
};

} // namespace hearth::import
