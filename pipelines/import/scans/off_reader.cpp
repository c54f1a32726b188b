// Reads OFF: Geomview's Object File Format as text, with the prefixes ST, C and N in any combination.
// Source: Geomview manual, "OFF files".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/limit_messages.h"
#include "pipelines/import/scans/scan_polygons.h"
#include "pipelines/import/scans/text_cursor.h"

#include <array>
#include <cmath>

namespace hearth::import
{

namespace
{

struct OffKind
{
    bool has_uvs = false;
    bool has_colors = false;
    bool has_normals = false;
};

/// Maximum number of values of a vertex: position, normal, colour, UV.
constexpr size_t kMaxNumbers = 3 + 3 + 4 + 2;

class OffReader
{
public:
    explicit OffReader(const ScanSource& source) : source_(source), text_(source.text()) {}

    Result<ScanPolygons> read()
    {
        HEARTH_TRY(readKeyword());
        HEARTH_TRY(readCounts());
        for (uint64_t i = 0; i < vertex_count_; ++i)
            HEARTH_TRY(readVertex());
        for (uint64_t i = 0; i < face_count_; ++i)
            HEARTH_TRY(readFace());
        if (face_colors_)
            file_.note(Issue::dropped, "", "colours of faces are not kept");
        if (small_faces_ > 0)
            file_.note(Issue::dropped, "",
                       std::to_string(small_faces_) + " faces with fewer than three corners are not kept");
        file_.vertex_count = file_.positions.size();
        return std::move(file_);
    }

private:
    Error failure(Issue issue, std::string detail) const
    {
        return {issue, source_.path, text_.where(), std::move(detail)};
    }

    /// Skip blank lines and comments.
    void skipSpace()
    {
        for (text_.skipSpace(); text_.startsWith('#'); text_.skipSpace())
            text_.nextLine();
    }

    bool atRowEnd()
    {
        text_.skipBlanks();
        return text_.atLineEnd() || text_.startsWith('#');
    }

    /// Read the keyword, which may be missing; the counts may follow on its line.
    Status readKeyword()
    {
        skipSpace();
        TextCursor ahead = text_;
        std::string_view word = ahead.word();
        if (!word.ends_with("OFF"))
        {
            if (text_.number())
            {
                text_ = TextCursor(source_.text());
                skipSpace();
                return success();
            }
            return failure(Issue::mesh_syntax, "the file does not start with 'OFF'");
        }
        word.remove_suffix(3);
        const auto prefix = [&](std::string_view letters)
        {
            const bool found = word.starts_with(letters);
            word.remove_prefix(found ? letters.size() : 0);
            return found;
        };
        kind_.has_uvs = prefix("ST");
        kind_.has_colors = prefix("C");
        kind_.has_normals = prefix("N");
        if (!word.empty())
            return failure(Issue::mesh_syntax, "OFF files in four or n dimensions are not read");
        text_ = ahead;
        if (!atRowEnd() && TextCursor(text_).word() == "BINARY")
            return failure(Issue::mesh_syntax, "binary OFF files are not read");
        return success();
    }

    Status readCounts()
    {
        skipSpace();
        std::array<uint64_t, 3> counts{};
        size_t found = 0;
        for (; found < counts.size() && !atRowEnd(); ++found)
        {
            const auto number = text_.integer();
            if (!number || *number < 0)
                return failure(Issue::mesh_syntax, "a count is not a number");
            counts[found] = static_cast<uint64_t>(*number);
        }
        if (found < 2 || !atRowEnd())
            return failure(Issue::mesh_syntax, "the numbers of vertices, faces and edges are missing");
        vertex_count_ = counts[0];
        face_count_ = counts[1];
        // "0 0 0\n" and "1 0\n" are the shortest lines; the last needs no line end
        if (vertex_count_ > (text_.remaining() + 1) / 6 || face_count_ > (text_.remaining() + 1) / 2)
            return failure(Issue::mesh_counts,
                           std::to_string(vertex_count_) + " vertices and " + std::to_string(face_count_) +
                               " faces do not fit into the " + std::to_string(text_.remaining()) +
                               " bytes that are left");
        if (vertex_count_ > source_.limits.max_vertices)
            return failure(Issue::input_too_large,
                           describeExcess(vertex_count_, "vertices", source_.limits.max_vertices));
        return success();
    }

    Status readVertex()
    {
        skipSpace();
        std::array<double, kMaxNumbers> v{};
        size_t count = 0;
        for (; !atRowEnd(); ++count)
        {
            const auto number = count < kMaxNumbers ? text_.number() : std::nullopt;
            if (!number)
                return failure(Issue::mesh_syntax, "a vertex has what is not a number, or too many");
            v[count] = *number;
        }
        const size_t wanted =
            3u + (kind_.has_normals ? 3u : 0u) + (kind_.has_colors ? 3u : 0u) + (kind_.has_uvs ? 2u : 0u);
        const bool alpha = kind_.has_colors && count == wanted + 1;
        if (count < wanted)
            return failure(text_.atEnd() ? Issue::mesh_counts : Issue::mesh_syntax,
                           "vertex " + std::to_string(file_.positions.size()) + " of " +
                               std::to_string(vertex_count_) + " is incomplete");
        addVertex(v, alpha);
        if (!isFinite(file_.positions.back()))
            return failure(Issue::mesh_syntax, "a coordinate is not finite");
        return success();
    }

    /// Add a vertex: position, then normal, colour (0..1, or 0..255 if a value is greater than 1) and UV.
    void addVertex(const std::array<double, kMaxNumbers>& v, bool alpha)
    {
        size_t at = 0;
        const auto next = [&] { return static_cast<float>(v[at++]); };
        const auto vector = [&]
        {
            Float3 r;
            r.x = next();
            r.y = next();
            r.z = next();
            return r;
        };
        file_.positions.push_back(vector());
        if (kind_.has_normals)
            file_.normals.push_back(vector());
        if (kind_.has_colors)
        {
            const Float3 color = vector();
            const float a = alpha ? next() : 1;
            const float scale = color.x > 1 || color.y > 1 || color.z > 1 || a > 1 ? 1 / 255.0f : 1.0f;
            file_.colors.push_back(
                linearColor(color.x * scale, color.y * scale, color.z * scale, alpha ? a * scale : 1));
        }
        if (kind_.has_uvs)
        {
            const Float2 uv{next(), next()};
            file_.uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? Float2{uv.x, 1 - uv.y}
                                                                           : Float2{});
        }
    }

    Status readFace()
    {
        skipSpace();
        const auto count = text_.integer();
        const size_t first = file_.corner_positions.size();
        if (!count || *count < 0)
            return failure(text_.atEnd() ? Issue::mesh_counts : Issue::mesh_syntax,
                           "the number of corners of a face is missing");
        for (int64_t i = 0; i < *count; ++i)
        {
            text_.skipBlanks();
            const auto index = text_.integer();
            if (!index)
                return failure(Issue::mesh_counts,
                               "a face of " + std::to_string(*count) + " corners has " + std::to_string(i));
            if (*index < 0 || static_cast<uint64_t>(*index) >= file_.positions.size())
                return failure(Issue::index_out_of_range, "vertex index " + std::to_string(*index) + " of " +
                                                              std::to_string(file_.positions.size()) +
                                                              " vertices");
            file_.corner_positions.push_back(static_cast<uint32_t>(*index));
        }
        face_colors_ = face_colors_ || !atRowEnd();
        text_.nextLine();
        if (file_.corner_positions.size() - first < 3)
        {
            ++small_faces_;
            file_.corner_positions.resize(first);
            return success();
        }
        if (file_.corner_positions.size() > 3 * source_.limits.max_triangles)
            return failure(Issue::input_too_large,
                           "more than " + std::to_string(source_.limits.max_triangles) + " triangles");
        file_.face_ends.push_back(static_cast<uint32_t>(file_.corner_positions.size()));
        return success();
    }

    const ScanSource& source_;
    TextCursor text_;
    OffKind kind_;
    uint64_t vertex_count_ = 0;
    uint64_t face_count_ = 0;
    bool face_colors_ = false;
    uint64_t small_faces_ = 0;
    ScanPolygons file_;
};

} // namespace

Result<ScanPolygons> readOff(const ScanSource& source)
{
    return OffReader(source).read();
}

} // namespace hearth::import
