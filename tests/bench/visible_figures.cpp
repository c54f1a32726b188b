// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/visible_figures.h"

#include "formats/gpu_shared/records.h"
#include "formats/records/container.h"

#include <cstring>
#include <fstream>
#include <vector>

namespace hearth::bench
{

namespace
{

constexpr uint32_t kNothing = 0xffffffff;
constexpr uint32_t kTriangleBits = 7;

struct Dump
{
    std::vector<shared::VisibleCluster> slots;
    std::vector<uint32_t> pixels;
};

Result<Dump> readDump(const std::string& path)
{
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        return Error{Issue::input_missing, path, "", ""};
    const auto size = static_cast<size_t>(file.tellg());
    file.seekg(0);
    const auto read = [&](void* to, size_t bytes)
    { return bool(file.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))); };
    uint32_t header[4]; // magic, width, height, slots
    const Error no_dump{Issue::usage, path, "", "the file is no dump of what is visible"};
    if (!read(header, sizeof(header)) || header[0] != formats::fourCC("HVIS"))
        return no_dump;
    const uint64_t pixels = uint64_t{header[1]} * header[2];
    if (size != sizeof(header) + uint64_t{header[3]} * sizeof(shared::VisibleCluster) + pixels * 4)
        return no_dump;
    Dump dump{std::vector<shared::VisibleCluster>(header[3]), std::vector<uint32_t>(pixels)};
    if (!read(dump.slots.data(), dump.slots.size() * sizeof(shared::VisibleCluster)) ||
        !read(dump.pixels.data(), dump.pixels.size() * 4))
        return no_dump;
    return dump;
}

/// Count the pixels of each triangle of each slot.
Result<std::vector<uint32_t>> countPixels(const Dump& dump, const std::string& path)
{
    std::vector<uint32_t> pixels_of_triangle(dump.slots.size() << kTriangleBits);
    for (const uint32_t pixel : dump.pixels)
    {
        if (pixel == kNothing)
            continue;
        if (pixel >= pixels_of_triangle.size())
            return Error{Issue::usage, path, "", "a pixel shows a slot that is not there"};
        ++pixels_of_triangle[pixel];
    }
    return pixels_of_triangle;
}

std::string getKind(const formats::PackView& pack, uint32_t instance)
{
    const std::string_view name = pack.text(pack.meshes()[pack.instances()[instance].mesh].name);
    return std::string(name.substr(0, name.find('_')));
}

} // namespace

void VisibleFigures::add(const VisibleFigures& other)
{
    drawn_clusters += other.drawn_clusters;
    owning_clusters += other.owning_clusters;
    drawn_triangles += other.drawn_triangles;
    owning_triangles += other.owning_triangles;
    covered_pixels += other.covered_pixels;
}

double VisibleFigures::trianglesPerPixel() const
{
    return static_cast<double>(drawn_triangles) / static_cast<double>(covered_pixels);
}

double VisibleFigures::drawnOverOwning() const
{
    return static_cast<double>(drawn_clusters) / static_cast<double>(owning_clusters);
}

Result<FiguresOfKind> readVisibleFigures(const std::string& path, const formats::PackView& pack)
{
    HEARTH_ASSIGN_OR_RETURN(const Dump dump, readDump(path));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<uint32_t> pixels_of_triangle, countPixels(dump, path));
    FiguresOfKind figures;
    for (size_t slot = 0; slot < dump.slots.size(); ++slot)
    {
        const shared::VisibleCluster visible = dump.slots[slot];
        if (visible.instance >= pack.instances().size() || visible.cluster >= pack.clusters().size())
            return Error{Issue::usage, path, "", "the dump is of another pack"};
        VisibleFigures one{.drawn_clusters = 1,
                           .drawn_triangles = pack.clusters()[visible.cluster].triangle_count};
        for (size_t triangle = slot << kTriangleBits; triangle < (slot + 1) << kTriangleBits; ++triangle)
        {
            one.covered_pixels += pixels_of_triangle[triangle];
            one.owning_triangles += pixels_of_triangle[triangle] > 0 ? 1u : 0u;
        }
        one.owning_clusters = one.covered_pixels > 0 ? 1u : 0u;
        figures[getKind(pack, visible.instance)].add(one);
    }
    return figures;
}

VisibleFigures sumUp(const FiguresOfKind& figures)
{
    VisibleFigures sum;
    for (const auto& [kind, of_kind] : figures)
        sum.add(of_kind);
    return sum;
}

} // namespace hearth::bench
