// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_proxy.h"

#include "formats/base/atomic_file.h"
#include "pipelines/command/extract/open_pack.h"

#include <fmt/format.h>

namespace hearth::command
{

using namespace formats;

namespace
{

/// Arrays of a proxy.
struct ProxyArrays
{
    std::span<const Float3> positions;
    std::span<const uint32_t> indices;
    std::span<const ProxySectionRecord> sections;
};

void writePly(AtomicFile& file, const ProxyArrays& proxy)
{
    file.write(fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
                           "property float y\nproperty float z\nelement face {}\n"
                           "property list uchar int vertex_indices\nend_header\n",
                           proxy.positions.size(), proxy.indices.size() / 3));
    file.write(std::as_bytes(proxy.positions));
    std::vector<std::byte> faces;
    for (size_t i = 0; i < proxy.indices.size(); i += 3)
    {
        faces.push_back(std::byte{3});
        const auto corners = std::as_bytes(proxy.indices.subspan(i, 3));
        faces.insert(faces.end(), corners.begin(), corners.end());
    }
    file.write(faces);
}

/// Return a name for a group of an OBJ file, which spaces would end.
std::string groupName(const PackView& file, const ProxySectionRecord& section, size_t index)
{
    // the materials of a part are in another one
    std::string name = section.material < file.materials().size()
                           ? std::string(file.text(file.materials()[section.material].name))
                           : "";
    if (name.empty())
        name = section.material == kInvalidIndex ? fmt::format("section_{}", index)
                                                 : fmt::format("material_{}", section.material);
    for (char& c : name)
        if (static_cast<unsigned char>(c) <= ' ' || c == 0x7F)
            c = '_';
    return name;
}

void writeObj(AtomicFile& file, const PackView& pack, const ProxyArrays& proxy)
{
    std::string text;
    for (const Float3 position : proxy.positions)
        text += fmt::format("v {} {} {}\n", position.x, position.y, position.z);
    for (size_t s = 0; s < proxy.sections.size(); ++s)
    {
        const ProxySectionRecord& section = proxy.sections[s];
        text += fmt::format("g {}\n", groupName(pack, section, s));
        for (uint32_t t = section.triangles.first; t < section.triangles.first + section.triangles.count; ++t)
            text += fmt::format("f {} {} {}\n", proxy.indices[3 * t] + 1, proxy.indices[3 * t + 1] + 1,
                                proxy.indices[3 * t + 2] + 1);
    }
    file.write(text);
}

} // namespace

Status extractProxy(const std::string& path, uint32_t proxy, const std::string& output)
{
    const bool is_obj = output.ends_with(".obj");
    if (!is_obj && !output.ends_with(".ply"))
        return Error{Issue::usage, output, "", "a proxy is written as .ply or .obj"};
    HEARTH_ASSIGN_OR_RETURN(const PackView file, openContainer(path));
    if (file.proxies().empty())
        return Error{Issue::chunk_missing, path, chunkName(kChunkProxies, 0),
                     "the file has no proxies: cook with --proxy-from clean"};
    if (proxy >= file.proxies().size())
        return Error{Issue::usage, path, "",
                     fmt::format("there is no proxy {}: the file has {}", proxy, file.proxies().size())};
    const ProxyRecord& record = file.proxies()[proxy];
    const ProxyArrays arrays{recordsInRange(file.proxyPositions(), record.positions),
                             recordsInRange(file.proxyIndices(), record.indices),
                             recordsInRange(file.proxySections(), record.sections)};
    HEARTH_ASSIGN_OR_RETURN(AtomicFile mesh, AtomicFile::create(output));
    if (is_obj)
        writeObj(mesh, file, arrays);
    else
        writePly(mesh, arrays);
    return mesh.finish();
}

} // namespace hearth::command
