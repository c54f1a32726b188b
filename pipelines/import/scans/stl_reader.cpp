// Reads STL, ascii and binary. The file lists separate triangles; corners with bitwise equal positions become
// one vertex.
// Source: 3D Systems, "StereoLithography Interface Specification", 1988.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/scan_polygons.h"

#include "formats/base/byte_reader.h"
#include "pipelines/import/scans/text_cursor.h"

#include <array>
#include <bit>
#include <cstring>

namespace hearth::import
{

namespace
{

constexpr uint64_t kHeaderBytes = 80;
constexpr uint64_t kTriangleBytes = 50; ///< normal, three corners, two unused bytes

/// Hash table of positions by their bits, with open addressing; positions are numbered in the order of the
/// file.
class PositionTable
{
public:
    uint32_t findOrAdd(Float3 position)
    {
        if ((positions.size() + 1) * 2 > slots_.size())
            grow();
        const size_t slot = find(position);
        if (slots_[slot] == kInvalidIndex)
        {
            slots_[slot] = static_cast<uint32_t>(positions.size());
            positions.push_back(position);
        }
        return slots_[slot];
    }

    std::vector<Float3> positions;

private:
    size_t find(Float3 p) const
    {
        uint64_t hash = std::bit_cast<uint32_t>(p.x) * 0x9E3779B97F4A7C15u;
        hash = (hash ^ (hash >> 29) ^ std::bit_cast<uint32_t>(p.y)) * 0xBF58476D1CE4E5B9u;
        hash = (hash ^ (hash >> 32) ^ std::bit_cast<uint32_t>(p.z)) * 0x94D049BB133111EBu;
        const size_t mask = slots_.size() - 1;
        size_t slot = (hash ^ (hash >> 31)) & mask;
        while (slots_[slot] != kInvalidIndex && !(positions[slots_[slot]] == p))
            slot = (slot + 1) & mask;
        return slot;
    }

    void grow()
    {
        slots_.assign(std::max<size_t>(1024, slots_.size() * 2), kInvalidIndex);
        for (uint32_t i = 0; i < positions.size(); ++i)
            slots_[find(positions[i])] = i;
    }

    std::vector<uint32_t> slots_;
};

class StlReader
{
public:
    explicit StlReader(const ScanSource& source) : source_(source) {}

    Result<ScanPolygons> read()
    {
        HEARTH_TRY(isBinary() ? readBinary() : readAscii());
        file_.positions = std::move(table_.positions);
        file_.vertex_count = file_.corner_positions.size();
        return std::move(file_);
    }

private:
    Error failure(Issue issue, std::string where, std::string detail) const
    {
        return {issue, source_.path, std::move(where), std::move(detail)};
    }

    /// True for a binary file, which may start with "solid" too: the size decides, then bytes that no text
    /// contains.
    bool isBinary() const
    {
        const auto count = triangleCount();
        if (count && kHeaderBytes + 4 + *count * kTriangleBytes == source_.bytes.size())
            return true;
        const std::string_view start = source_.text().substr(0, 1024);
        TextCursor text(start);
        text.skipSpace();
        return !startsWithKeyword(text, "solid") || std::any_of(start.begin(), start.end(), isControlByte);
    }

    std::optional<uint64_t> triangleCount() const
    {
        ByteReader reader(source_.bytes);
        reader.seek(kHeaderBytes);
        const auto count = reader.position() == kHeaderBytes ? reader.read<uint32_t>() : std::nullopt;
        return count ? std::optional<uint64_t>(*count) : std::nullopt;
    }

    Status readBinary()
    {
        const auto count = triangleCount();
        if (!count)
            return failure(Issue::mesh_counts, "byte 0",
                           "the file is neither an ascii STL nor long enough for a binary one");
        const auto triangles = checkedPart(source_.bytes, kHeaderBytes + 4, *count, kTriangleBytes);
        const uint64_t available = (source_.bytes.size() - kHeaderBytes - 4) / kTriangleBytes;
        if (!triangles)
            return failure(Issue::mesh_counts, "byte 80",
                           "the header says " + std::to_string(*count) + " triangles, the file has " +
                               std::to_string(available));
        for (uint64_t i = 0; i < *count; ++i)
        {
            std::array<Float3, 4> values; // the normal, which is recomputed, then the corners
            std::memcpy(values.data(), triangles->data() + i * kTriangleBytes, sizeof(values));
            for (size_t k = 1; k < 4; ++k)
                if (!addCorner(values[k]))
                    return failure(Issue::mesh_syntax,
                                   "byte " + std::to_string(kHeaderBytes + 4 + i * kTriangleBytes),
                                   "triangle " + std::to_string(i) + " has a coordinate that is not finite");
            HEARTH_TRY(endTriangle("byte " + std::to_string(kHeaderBytes + 4)));
        }
        const size_t rest = source_.bytes.size() - (kHeaderBytes + 4 + triangles->size());
        if (rest > 0)
            file_.note(Issue::dropped, "",
                       std::to_string(rest) + " bytes behind the last triangle are not kept");
        return success();
    }

    static bool startsWithKeyword(TextCursor text, std::string_view keyword)
    {
        const std::string_view word = text.word();
        return word.size() == keyword.size() && std::equal(word.begin(), word.end(), keyword.begin(),
                                                           [](char a, char b) { return (a | 0x20) == b; });
    }

    static bool accept(TextCursor& text, std::string_view keyword)
    {
        text.skipSpace();
        if (!startsWithKeyword(text, keyword))
            return false;
        text.word();
        return true;
    }

    /// Read solid NAME { facet normal X Y Z outer loop (vertex X Y Z) x 3 endloop endfacet } endsolid NAME,
    /// repeated.
    Status readAscii()
    {
        TextCursor text(source_.text());
        for (text.skipSpace(); !text.atEnd(); text.skipSpace())
        {
            if (!accept(text, "solid"))
                return failure(Issue::mesh_syntax, text.where(), "'solid' is missing");
            text.nextLine();
            while (accept(text, "facet"))
                HEARTH_TRY(readFacet(text));
            if (!accept(text, "endsolid"))
                return failure(text.atEnd() ? Issue::mesh_counts : Issue::mesh_syntax, text.where(),
                               "neither 'facet' nor 'endsolid' follows");
            text.nextLine();
        }
        return success();
    }

    Status readFacet(TextCursor& text)
    {
        const auto wrong = [&](const char* what)
        { return failure(text.atEnd() ? Issue::mesh_counts : Issue::mesh_syntax, text.where(), what); };
        if (!accept(text, "normal"))
            return wrong("'normal' is missing");
        for (int i = 0; i < 3; ++i)
            text.word(); // recomputed; exporters write "nan" and worse here for triangles without area
        if (!accept(text, "outer") || !accept(text, "loop"))
            return wrong("'outer loop' is missing");
        for (int corner = 0; corner < 3; ++corner)
        {
            if (!accept(text, "vertex"))
                return wrong("'vertex' is missing: a facet has three");
            std::array<double, 3> v{};
            for (double& value : v)
            {
                const auto number = text.number();
                if (!number)
                    return wrong("a coordinate is not a number");
                value = *number;
            }
            if (!addCorner({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}))
                return wrong("a coordinate is not finite");
        }
        if (!accept(text, "endloop") || !accept(text, "endfacet"))
            return wrong("'endloop endfacet' is missing");
        return endTriangle(text.where());
    }

    bool addCorner(Float3 position)
    {
        if (!isFinite(position))
            return false;
        // -0 and 0 are the same coordinate
        file_.corner_positions.push_back(table_.findOrAdd(position + Float3{0, 0, 0}));
        return true;
    }

    Status endTriangle(std::string where)
    {
        if (file_.face_ends.size() == source_.limits.max_triangles)
            return failure(Issue::input_too_large, std::move(where),
                           "more than " + std::to_string(source_.limits.max_triangles) + " triangles");
        file_.face_ends.push_back(static_cast<uint32_t>(file_.corner_positions.size()));
        return success();
    }

    const ScanSource& source_;
    PositionTable table_;
    ScanPolygons file_;
};

} // namespace

Result<ScanPolygons> readStl(const ScanSource& source)
{
    return StlReader(source).read();
}

} // namespace hearth::import
