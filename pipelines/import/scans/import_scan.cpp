// Imports a scan as one mesh, one node and one instance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/import_scan.h"

#include "pipelines/import/part/generate_normals.h"
#include "pipelines/import/part/generate_tangents.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/part/part_proxies.h"
#include "pipelines/import/part/proxy_name.h"
#include "pipelines/import/part/receiver_uvs.h"
#include "pipelines/import/scans/obj_materials.h"
#include "pipelines/import/scans/scan_polygons.h"
#include "pipelines/import/scans/text_cursor.h"

#include <algorithm>
#include <array>

namespace hearth::import
{

namespace
{

using namespace std::string_view_literals;
using Reader = Result<ScanPolygons> (*)(const ScanSource&);

struct ScanFormat
{
    std::string_view extension;
    Reader read;
};
constexpr std::array kFormats = {ScanFormat{".obj", readObj}, ScanFormat{".ply", readPly},
                                 ScanFormat{".stl", readStl}, ScanFormat{".off", readOff},
                                 ScanFormat{".drc", readDrc}};

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

/// Choose the reader by signature where the format has one, else by file name.
Reader chooseReader(const ScanSource& source)
{
    const std::string_view text = source.text();
    if (text.starts_with("DRACO"))
        return readDrc;
    if (text.starts_with("ply\n") || text.starts_with("ply\r"))
        return readPly;
    if (text.starts_with("OFF\n") || text.starts_with("OFF\r"))
        return readOff;
    const std::string name = lowerCase(source.path);
    const auto found =
        std::find_if(kFormats.begin(), kFormats.end(),
                     [&](const ScanFormat& format) { return name.ends_with(format.extension); });
    return found == kFormats.end() ? nullptr : found->read;
}

/// Return the file name without folder and extension: "skull" for "folder/skull.obj".
std::string fileStem(const std::string& path)
{
    const std::string name = path.substr(path.rfind('/') + 1);
    return name.substr(0, name.rfind('.'));
}

/// Add the materials of the scan; faces without one get a default that shows their shape.
Status addMaterials(ScanPolygons& scan, const ScanSource& source, const ImportOptions& options,
                    PartBuilder& part)
{
    part.counts.materials = scan.material_names.size();
    HEARTH_ASSIGN_OR_RETURN(const ScanMaterialIndices indices,
                            addScanMaterials(scan, source.path, options, part));
    scan.face_materials.resize(scan.face_ends.size(), kInvalidIndex);
    for (uint32_t& material : scan.face_materials)
        material = material == kInvalidIndex ? kInvalidIndex : indices.by_name[material];
    if (std::find(scan.face_materials.begin(), scan.face_materials.end(), kInvalidIndex) ==
        scan.face_materials.end())
        return success();
    const auto fallback = static_cast<uint32_t>(part.materials.size());
    part.materials.push_back(indices.fallback);
    part.materials.back().name = part.intern("default");
    std::replace(scan.face_materials.begin(), scan.face_materials.end(), kInvalidIndex, fallback);
    return success();
}

bool usesNormalMaps(const PartBuilder& part)
{
    return std::any_of(part.materials.begin(), part.materials.end(),
                       [](const formats::MaterialRecord& m)
                       { return m.normal_texture.image != kInvalidIndex; });
}

/// Add the proxies from files, all of which are of the only mesh. errors: usage
Status addFileProxies(const mesh::SourceMesh& mesh, const ImportOptions& options, PartBuilder& part)
{
    if (options.file_proxies == nullptr)
        return success();
    std::vector<std::string_view> material_names;
    for (const formats::MaterialRecord& material : part.materials)
        material_names.push_back(part.text(material.name));
    std::vector<ProxyPiece> pieces;
    for (const FileProxies& proxies : *options.file_proxies)
    {
        if (!proxies.mesh.empty() && lowerProxyStem(proxies.mesh) != lowerProxyStem(mesh.name))
            return findNoMeshError(proxies, {&mesh.name, 1});
        for (const FileProxyPiece& piece : proxies.pieces)
            pieces.push_back(matchMaterials(material_names, piece));
    }
    addProxies(0, mesh, pieces, part);
    return success();
}

} // namespace

void addOnlyInstance(const std::string& name, PartBuilder& part)
{
    formats::NodeRecord node{};
    node.name = part.intern(name);
    node.parent = node.skin = kInvalidIndex;
    node.mesh = 0;
    node.has_trs = 1;
    node.rotation = {0, 0, 0, 1};
    node.scale = {1, 1, 1};
    node.parent_from_node = Affine3{};
    part.nodes.push_back(node);

    formats::InstanceRecord instance{};
    instance.world_from_object = Affine3{};
    instance.mesh = 0;
    instance.node = 0;
    instance.scale_max = 1;
    part.instances.push_back(instance);
}

Status importScan(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                  PartBuilder& part)
{
    const ScanSource source{bytes, path, options.limits};
    const Reader read = chooseReader(source);
    if (read == nullptr)
        return Error{Issue::input_kind_unknown, path, "", ""};
    HEARTH_ASSIGN_OR_RETURN(ScanPolygons scan, read(source));
    if (scan.positions.empty())
        return Error{Issue::mesh_empty, path, "", "the file has no vertices"};
    for (const ScanNote& note : scan.notes)
        part.warn(note.issue, note.where, note.detail);
    if (scan.face_ends.empty())
        part.warn(Issue::nothing_drawn, "", "the file has points but no faces");

    HEARTH_TRY(addMaterials(scan, source, options, part));
    mesh::SourceMesh mesh = meshFromScan(std::move(scan));
    mesh.name = fileStem(path);
    if (mesh.normals.empty())
        generateNormals(mesh, options.crease_angle_rad);
    if (usesNormalMaps(part) && !mesh.uvs[0].empty())
        generateTangents(mesh, 0);

    if (options.receiver_texel_size > 0)
        addReceiverUvs(mesh, options.receiver_texel_size);

    part.counts.triangles = mesh.triangleCount();
    part.counts.faces = mesh.face_count;
    part.counts.vertices = mesh.source_vertex_count;
    HEARTH_TRY(part.addMesh(mesh));
    HEARTH_TRY(addFileProxies(mesh, options, part));
    addOnlyInstance(mesh.name, part);
    return success();
}

} // namespace hearth::import
