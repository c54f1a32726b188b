// Tests the JSON Schema checker that other tests use: each keyword accepts and rejects the right values.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/json_schema.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// JSON texts: a schema, values that it accepts, and values that it rejects.
struct Row
{
    const char* schema;
    std::vector<const char*> good;
    std::vector<const char*> bad;
};

} // namespace

TEST(JsonSchema, eachKeywordTakesAndRefuses)
{
    const std::vector<Row> rows{
        {R"({"type": "integer"})", {"1", "-3"}, {"1.5", "true", "\"1\"", "null"}},
        {R"({"type": ["string", "null"]})", {"\"\"", "null"}, {"0", "[]"}},
        {R"({"type": "boolean"})", {"true"}, {"0"}},
        {R"({"enum": ["a", 4]})", {"\"a\"", "4"}, {"\"b\"", "5"}},
        {R"({"const": "x/1"})", {"\"x/1\""}, {"\"x/2\""}},
        {R"({"minimum": 2})", {"2", "3.5", "\"a\""}, {"1.9"}},
        {R"({"exclusiveMinimum": 0})", {"0.1", "null"}, {"0", "-1"}},
        {R"({"maximum": 2})", {"2", "-5"}, {"2.1"}},
        {R"({"minLength": 2})", {"\"ab\"", "\"\u00e4\u00e4\"", "1"}, {"\"a\"", "\"\u00e4\""}},
        {R"({"pattern": "^[1-9]+$"})", {"\"12\"", "0"}, {"\"10\""}},
        {R"({"minItems": 1})", {"[0]", "{}"}, {"[]"}},
        {R"({"items": {"type": "string"}})", {"[]", "[\"a\"]", "1"}, {"[\"a\", 1]"}},
        {R"({"required": ["a"]})", {R"({"a": null})", "[]"}, {"{}", R"({"b": 1})"}},
        {R"({"properties": {"a": {"type": "null"}}})", {R"({"a": null})", R"({"b": 1})"}, {R"({"a": 1})"}},
        {R"({"properties": {"a": {}}, "additionalProperties": false})",
         {R"({"a": 1})", "{}"},
         {R"({"b": 1})"}},
        {R"({"additionalProperties": {"type": "null"}})", {R"({"b": null})"}, {R"({"b": 1})"}},
        {R"({"allOf": [{"minimum": 1}, {"maximum": 2}]})", {"1", "2"}, {"0", "3"}},
        {R"({"oneOf": [{"type": "string"}, {"minimum": 1, "type": "number"}]})",
         {"\"a\"", "1"},
         {"0", "null"}},
        {R"({"oneOf": [{"minimum": 1}, {"minimum": 2}]})", {"1.5"}, {"0", "2"}},
        {R"({"$defs": {"one": {"const": 1}}, "properties": {"a": {"$ref": "#/$defs/one"}}})",
         {R"({"a": 1})"},
         {R"({"a": 2})"}},
        {R"({"maxItems": 1})", {"[0]", "{}"}, {"[0, 0]"}},
        {R"({"if": {"type": "string"}, "then": {"minLength": 1}, "else": {"minimum": 1}})",
         {"\"a\"", "1"},
         {"\"\"", "0"}},
        {R"({"if": {"const": 1}, "then": {"const": 2}})", {"0"}, {"1"}},
        {"true", {"1"}, {}},
        {"false", {}, {"1"}},
        {R"({"minimun": 1})", {}, {"1"}},
    };
    for (const Row& row : rows)
    {
        const Json schema = Json::parse(row.schema).value();
        for (const char* value : row.good)
            EXPECT_EQ(findFault(schema, Json::parse(value).value()), "") << row.schema;
        for (const char* value : row.bad)
            EXPECT_NE(findFault(schema, Json::parse(value).value()), "") << row.schema << " " << value;
    }
}

} // namespace hearth::test
