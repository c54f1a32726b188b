// Places of a document in messages: one message tells where a thing is, however often it is there.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/json_document.h"

namespace hearth::import
{

/// Way from the root of a document to a value, made while the document is walked. Json::pointer() searches
/// each array for the value, which would take quadratic time for all elements.
struct JsonPath
{
    const JsonPath* parent; ///< null: the root
    Json value;
    size_t index; ///< of the value in its parent

    /// Return the JSON pointer of the value.
    std::string pointer() const;
};

/// List of places, of which the first few are kept.
class PlaceList
{
public:
    void add(const JsonPath& path);

    bool empty() const { return count_ == 0; }
    /// Return the pointer of the first place; empty if there is none.
    std::string first() const { return empty() ? "" : pointers_.front(); }
    /// Return " (3 places: /materials/0, /materials/2 and /nodes/7)"; at most four are named. Empty for one
    /// place or none, which first() names.
    std::string list() const;

private:
    uint64_t count_ = 0;
    std::vector<std::string> pointers_;
};

} // namespace hearth::import
