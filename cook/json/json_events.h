// Reads a JSON text piece by piece, for those who keep it in a form of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hearth
{

/// Receives the pieces of a JSON text in its order. Each function says whether to go on. Texts may be moved
/// from.
class JsonEvents
{
public:
    virtual bool null() = 0;
    virtual bool boolean(bool value) = 0;
    virtual bool integer(int64_t value) = 0; ///< a whole number below zero
    virtual bool unsignedInteger(uint64_t value) = 0;
    virtual bool number(double value) = 0; ///< all others, also whole numbers that do not fit 64 bits
    virtual bool string(std::string& text) = 0;
    virtual bool beginArray() = 0;
    virtual bool endArray() = 0;
    virtual bool beginObject() = 0;
    virtual bool key(std::string& text) = 0; ///< the value follows
    virtual bool endObject() = 0;

protected:
    ~JsonEvents() = default;
};

/// Hand the text's pieces to `events`, strictly (RFC 8259, in UTF-8; a number too large for a double is a
/// fault).
/// returns  the number of bytes that had been read when the text turned out to be no JSON; nullopt where it
///          is JSON, or `events` did not want to go on
std::optional<size_t> parseJson(std::string_view text, JsonEvents& events);

} // namespace hearth
