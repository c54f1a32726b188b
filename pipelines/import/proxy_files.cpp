// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/proxy_files.h"

#include "formats/pack/pack_view.h"
#include "pipelines/import/part/bake_transform.h"
#include "pipelines/import/part/proxy_name.h"
#include "pipelines/import/read_source.h"
#include "pipelines/import/source/asset_folder.h"

#include <fmt/format.h>

namespace hearth::import
{

using namespace formats;

namespace
{

/// Split "MESH=FILE" or "FILE". errors: usage
Result<FileProxies> parseWord(const std::string& word)
{
    const size_t equals = word.find('=');
    FileProxies proxies;
    proxies.word = word;
    if (equals != std::string::npos)
        proxies.mesh = word.substr(0, equals);
    proxies.file = equals == std::string::npos ? word : word.substr(equals + 1);
    if (equals == 0 || proxies.file.empty())
        return Error{Issue::usage, "--proxy " + word, "",
                     "must be a file, or the name of a mesh or node, = and a file, as in --proxy "
                     "Rock=rock_proxy.obj"};
    return proxies;
}

/// Resolve the path of a file. errors: those of AssetFolder::locate, which say from where paths count
Result<std::string> locateFile(const AssetFolder& folder, const std::string& file)
{
    Result<std::string> path = folder.locate(file);
    if (path.ok())
        return path;
    Error error = path.error();
    error.detail += fmt::format("{}a file of --proxy is sought in the folder of {}",
                                error.detail.empty() ? "" : "; ", folder.assetName());
    return error;
}

bool isCalledConvex(std::string_view name)
{
    const std::optional<ProxyName> parsed = parseProxyName(name);
    return parsed && parsed->is_convex;
}

/// Read the mesh of an instance where it is drawn.
Result<FileProxyPiece> readPiece(const PackView& from, const InstanceRecord& instance,
                                 const std::string& file)
{
    FileProxyPiece piece;
    HEARTH_ASSIGN_OR_RETURN(piece.mesh, mesh::readSourceMesh(from.container(), instance.mesh));
    if (!bakeTransform(piece.mesh, widened(instance.world_from_object)))
        return Error{Issue::number_too_large, file, piece.mesh.name,
                     "a proxy cannot be moved to its place: its transform has no inverse"};
    const std::string_view node = from.text(from.nodes()[instance.node].name);
    piece.is_convex = isCalledConvex(node) || isCalledConvex(piece.mesh.name);
    for (const MaterialRecord& material : from.materials())
        piece.material_names.emplace_back(from.text(material.name));
    piece.where = file;
    return piece;
}

} // namespace

Result<std::vector<FileProxies>> readProxyFiles(std::span<const std::string> words, const std::string& source,
                                                const std::string& temporary_folder,
                                                const ImportOptions& options, PartBuilder& part)
{
    const AssetFolder folder(source, options.reads);
    ImportOptions of_files = options;
    of_files.proxies = AuthoredProxies::unknown;
    of_files.receiver_texel_size = 0;
    of_files.takes_sky = false;
    std::vector<FileProxies> all;
    for (const std::string& word : words)
    {
        HEARTH_ASSIGN_OR_RETURN(FileProxies proxies, parseWord(word));
        HEARTH_ASSIGN_OR_RETURN(const std::string path, locateFile(folder, proxies.file));
        const std::string part_path = fmt::format("{}/proxy_{}.part", temporary_folder, all.size());
        HEARTH_ASSIGN_OR_RETURN(PartBuilder file, PartBuilder::create(part_path, path));
        HEARTH_TRY(readSource(path, of_files, file));
        HEARTH_TRY(file.finish());
        part.mergeReport(file);
        HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(part_path, Check::structure));
        HEARTH_ASSIGN_OR_RETURN(const PackView view, PackView::read(std::move(reader)));
        for (const InstanceRecord& instance : view.instances())
        {
            HEARTH_ASSIGN_OR_RETURN(FileProxyPiece piece, readPiece(view, instance, proxies.file));
            proxies.pieces.push_back(std::move(piece));
        }
        all.push_back(std::move(proxies));
    }
    return all;
}

} // namespace hearth::import
