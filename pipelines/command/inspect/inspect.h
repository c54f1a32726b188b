// hearth inspect: summarizes the contents of a pack in numbers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// File or node that an authored level comes from.
struct AuthoredSummary
{
    std::string name;               ///< name of the file or node; may be empty
    std::optional<uint32_t> number; ///< 3 for rock_LOD3
};

struct LevelSummary
{
    uint32_t clusters = 0;
    uint32_t triangles = 0;
    float max_error = 0; ///< object space; the errors below are its parts, each the largest in the level
    float position_error = 0;
    float normal_error = 0;                  ///< radians
    float uv_error = 0;                      ///< object space
    std::optional<AuthoredSummary> authored; ///< nullopt: the level was generated, or is the source
};

struct MeshSummary
{
    std::string name;
    uint32_t attributes = 0;
    uint32_t source_triangles = 0;
    uint32_t source_vertices = 0;
    uint32_t source_faces = 0;
    uint32_t degenerate_triangles = 0;
    uint32_t morph_targets = 0;
    bool skinned = false;
    Float3 box_min;
    Float3 box_max;
    std::vector<LevelSummary> levels;
    uint32_t groups = 0;
    uint32_t clusters = 0;
    uint32_t pages = 0;
    uint64_t triangles = 0; ///< over all clusters
    uint64_t vertices = 0;  ///< over all clusters
    uint64_t vertex_bytes = 0;
    uint64_t index_bytes = 0;
    uint64_t page_bytes = 0;        ///< decoded
    uint64_t stored_page_bytes = 0; ///< as stored in the file
    uint64_t record_bytes = 0;      ///< of its records
    uint64_t bounds_bytes = 0;      ///< of its records in chunks DMSH, DCLU and DJNT
};

struct MessageSummary
{
    std::string source;
    std::string code;
    std::string where;
    std::string text;
};

struct SourceSummary
{
    std::string name;
    uint64_t bytes = 0;
    std::string hash;
};

/// Compression of an animation clip by the import.
struct ClipSummary
{
    uint64_t keys_before = 0;
    uint64_t keys = 0;
    uint64_t bytes_before = 0;
    uint64_t bytes = 0;
    double stated_error = 0; ///< metres
    double proven_error = 0;
};

/// Content of chunk META, as far as it could be read.
struct MetaSummary
{
    std::string tool_version;
    std::vector<SourceSummary> sources;
    std::map<std::string, uint64_t> counts; ///< of the source files: "triangles", "vertices", "faces", ...
    std::vector<ClipSummary> clips;         ///< in the order of the animations
    std::vector<MessageSummary> messages;
    std::vector<std::string> dropped;
    std::string no_bricks;       ///< why the cook made none; empty: switched off, or it made some
    std::string no_receivers;    ///< the same of receivers
    uint64_t texture_budget = 0; ///< bytes that the textures may take on the GPU; 0: the cook had no budget
    std::vector<MessageSummary> skipped; ///< errors of sources that the pack lacks
};

struct PackSummary
{
    MetaSummary meta;
    std::vector<MeshSummary> meshes;
    uint32_t joint_nodes = 0; ///< number of distinct nodes
    uint32_t morph_targets = 0;
    uint64_t instanced_triangles = 0; ///< of the finest level, over all instances
};

/// Sizes of the brick grid, for a pack that has one.
struct BricksSummary
{
    uint64_t bytes = 0;        ///< in memory, of its tables
    uint64_t stored_bytes = 0; ///< as stored in the file
};
BricksSummary summarizeBricks(const formats::PackView& pack);

/// Lamp of receivers, in words.
struct ReceiverLampSummary
{
    const char* kind = ""; ///< "steady", "light", "instance"
    std::string name;      ///< of the light, or of the instance's node; empty in a part
};
ReceiverLampSummary summarizeLamp(const formats::PackView& pack, const formats::ReceiverLampRecord& lamp);

/// Return the name of an instance's node; empty in a part of receivers alone.
std::string_view readInstanceName(const formats::PackView& pack, uint32_t instance);

/// Bytes of the chunks of receivers.
struct ReceiverBytes
{
    uint64_t bytes = 0;        ///< in memory
    uint64_t stored_bytes = 0; ///< as stored in the file
};
ReceiverBytes sumReceiverBytes(const formats::PackView& pack, std::span<const uint32_t> chunks);
const char* receiverCodecName(uint32_t codec);

/// Return "cleaned", "wrapped" or "authored"; "unknown" for other numbers.
const char* proxyOriginName(uint32_t origin);

PackSummary summarize(const formats::PackView& pack);

/// Read chunk META of a part or a pack; absent values and values of the wrong type are left out.
MetaSummary readMeta(std::string_view json);

/// Return the summary as text for people.
std::string inspectText(const formats::PackView& pack, const PackSummary& summary);

/// Return the summary as JSON, schema "hearth.inspect/1".
std::string inspectJson(const formats::PackView& pack, const PackSummary& summary);

/// Return the name of a value in a record.
std::string attributeNames(uint32_t attributes);
const char* alphaModeName(uint32_t mode);
const char* lightTypeName(uint32_t type);
const char* codecName(uint32_t codec);
std::string_view extrasOwnerName(uint32_t owner);

/// Return the name of the object that has the extras; empty if it has none, or is not there.
std::string_view readOwnerName(const formats::PackView& pack, const formats::ExtrasRecord& extras);

} // namespace hearth::command
