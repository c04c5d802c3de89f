#include "vispline/results/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vispline {
namespace {

TEST(Json, KeepsOrderAndTypes) {
  JsonObject inner;
  inner.set("b", 1).set("a", std::int64_t{9007199254740993});
  JsonObject object;
  object.set("z", 0.1).set("text", "two\n\"words\"").set("flag", true).set("inner", inner);
  object.set("list", std::vector<JsonObject>{inner}).set("none", std::vector<JsonObject>{});
  EXPECT_EQ(object.text(),
            "{\n"
            "  \"z\": 0.1,\n"
            "  \"text\": \"two\\n\\\"words\\\"\",\n"
            "  \"flag\": true,\n"
            "  \"inner\": {\n    \"b\": 1,\n    \"a\": 9007199254740993\n  },\n"
            "  \"list\": [\n    {\n      \"b\": 1,\n      \"a\": 9007199254740993\n    }\n  ],\n"
            "  \"none\": []\n"
            "}\n");
}

TEST(Json, NumbersThatAreNotFiniteAreNull) {
  JsonObject object;
  object.set("nan", std::nan("")).set("inf", -std::numeric_limits<double>::infinity());
  object.set("absent", std::optional<double>()).set("list", std::vector<double>{1.5, std::nan("")});
  EXPECT_EQ(object.text(),
            "{\n  \"nan\": null,\n  \"inf\": null,\n  \"absent\": null,\n  \"list\": [\n    1.5,\n    null\n  ]\n}\n");
}

TEST(Json, MatricesAreRows) {
  Matrix3d matrix;
  matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9.5;
  JsonObject object;
  object.set("m", matrix).set("v", Vector3d(1.0, 2.0, 0.25));
  std::string text = object.text();
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_EQ(text, R"({"m":[[1.0,2.0,3.0],[4.0,5.0,6.0],[7.0,8.0,9.5]],"v":[1.0,2.0,0.25]})");
}

TEST(Json, BytesThatAreNotTextAreReplaced) {
  JsonObject object;
  object.set("name",
             "a\xff"
             "b");
  EXPECT_EQ(object.text(),
            "{\n  \"name\": \"a\xef\xbf\xbd"
            "b\"\n}\n");
}

TEST(Json, CopiesAreDeepAndTheLastValueOfAKeyStays) {
  JsonObject original;
  original.set("a", 1);
  JsonObject copy = original;
  copy.set("a", 2);
  EXPECT_EQ(original.text(), "{\n  \"a\": 1\n}\n");
  original = copy;
  EXPECT_EQ(original.text(), "{\n  \"a\": 2\n}\n");
}

TEST(Json, DocumentsCarryVersionCountsAndDiagnostics) {
  JsonContext context{.version = "0.1.0", .inputs = {}, .diagnostics = {}};
  context.inputs.push_back({"first", {.read = 10, .kept = 7, .dropped = {{"W-ORDER", 1}, {"W-NONFINITE", 2}}}});
  context.inputs.push_back({"second", {.read = 5, .kept = 4, .dropped = {{"W-NONFINITE", 1}}}});
  context.diagnostics.add({"W-NONFINITE", "m", "w", "e", "n"});
  Diagnostics own;
  for (int i = 0; i < 5; ++i) own.add({"W-GAP", "gap", "", "", ""});
  JsonObject document = begin_document("vispline.test/1", context);
  end_document(document.set("value", 1), context, own);
  std::string text = document.text();
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  const std::string gap = R"({"code":"W-GAP","message":"gap","where":"","effect":"","next":""})";
  EXPECT_EQ(text,
            R"({"schema":"vispline.test/1","version":"0.1.0","value":1,"samples_read":15,"samples_kept":11,)"
            R"("samples_dropped":{"W-NONFINITE":3,"W-ORDER":1},"inputs":[)"
            R"({"name":"first","samples_read":10,"samples_kept":7,"samples_dropped":{"W-NONFINITE":2,"W-ORDER":1}},)"
            R"({"name":"second","samples_read":5,"samples_kept":4,"samples_dropped":{"W-NONFINITE":1}}],)"
            R"("diagnostics":[{"code":"W-NONFINITE","message":"m","where":"w","effect":"e","next":"n"},)" +
                gap + "," + gap + "," + gap + R"(],"diagnostic_counts":{"W-GAP":5,"W-NONFINITE":1}})");
}

TEST(Json, DocumentsWithoutInputsHaveNoCounts) {
  const JsonContext context{.version = "0.1.0", .inputs = {}, .diagnostics = {}};
  JsonObject document = begin_document("vispline.test/1", context);
  end_document(document, context);
  EXPECT_EQ(document.text().find("samples_read"), std::string::npos);
  EXPECT_NE(document.text().find("\"diagnostics\": []"), std::string::npos);
}

}  // namespace
}  // namespace vispline
