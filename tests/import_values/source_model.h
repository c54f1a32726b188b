// A glTF file as tinygltf reads it, with its compressed buffer views decoded: the source side of the
// comparison, which uses nothing of the product.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::test
{

struct SourceModel
{
    tinygltf::Model model;
    std::vector<std::vector<uint8_t>> views; ///< bytes of each buffer view, decoded
    std::string error;                       ///< empty if the file could be read
};

/// Read a .gltf or .glb file. Images are not decoded.
SourceModel readSourceModel(const std::string& path);

/// Values of an accessor or of a compressed attribute.
struct SourceValues
{
    std::vector<double> values;
    size_t components = 1;
    bool is_exact = true; ///< floats and integers; false: normalised integers, which part values round

    size_t count() const { return values.size() / components; }
    /// Throws std::out_of_range for an element that is not there.
    double at(size_t element, size_t component) const { return values.at(element * components + component); }
};

/// Read an accessor: strides, normalised integers, sparse replacements, zeros where there is no buffer view.
/// Throws std::out_of_range if the file has fewer bytes.
SourceValues readValues(const SourceModel& source, int accessor);

/// Return value / max for a normalised integer of a glTF component type, at least -1; the value for floats.
double normalised(double value, int component_type);

/// Return the transform of three rows and four columns of a node, from its parent.
struct SourceTransform
{
    double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};
SourceTransform operator*(const SourceTransform& a, const SourceTransform& b);
/// translation * rotation (quaternion x y z w of any length but 0) * scale
SourceTransform fromTrs(const double* translation, const double* rotation, const double* scale);
/// 16 numbers, column by column
SourceTransform fromColumns(const double* columns);
SourceTransform nodeTransform(const tinygltf::Node& node);

} // namespace hearth::test
