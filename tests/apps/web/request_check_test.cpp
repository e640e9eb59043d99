// Which requests the live page answers.

#include "apps/web/request_check.h"

#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

HttpRequest request(const std::string& host, const std::string& origin = {}, const std::string& site = {},
                    const std::string& path = "/pixels") {
  HttpRequest r;
  r.method = "GET", r.path = path, r.host = host, r.origin = origin, r.fetch_site = site;
  return r;
}

bool answers(HttpRequest r, const PageAddress& address) {
  return !refusal(&r, address);
}

TEST(RequestCheck, LocalPagesAnswerToThisMachineOnly) {
  const PageAddress local{"127.0.0.1", 4711};
  for (const char* host : {"127.0.0.1:4711", "localhost:4711", "[::1]:4711"})
    EXPECT_TRUE(answers(request(host), local));
  // Names that someone lets point to 127.0.0.1, other ports, and none.
  for (const char* host : {"evil.example:4711", "127.0.0.1.evil.example:4711", "127.0.0.1:4712", "localhost",
                           "127.0.0.1", "", "LOCALHOST:4711@evil.example"})
    EXPECT_FALSE(answers(request(host), local)) << host;
}

TEST(RequestCheck, PagesOfOthersGetNothing) {
  const PageAddress local{"127.0.0.1", 4711};
  const auto from = [&](const char* origin, const char* site) {
    return answers(request("localhost:4711", origin, site), local);
  };
  EXPECT_TRUE(from("http://localhost:4711", "same-origin"));
  EXPECT_TRUE(from("", "none"));  // the address was typed
  EXPECT_FALSE(from("http://evil.example", "cross-site"));
  EXPECT_FALSE(from("http://localhost:8080", ""));
  EXPECT_FALSE(from("null", ""));
  EXPECT_FALSE(from("", "cross-site"));
  EXPECT_FALSE(from("", "same-site"));
}

TEST(RequestCheck, OtherMachinesNeedTheToken) {
  const PageAddress open{"192.168.1.5", 4711, random_token()};
  EXPECT_EQ(open.url(), "http://192.168.1.5:4711/" + open.token + "/");
  HttpRequest right = request("192.168.1.5:4711", {}, {}, "/" + open.token + "/pixels");
  EXPECT_FALSE(refusal(&right, open));
  EXPECT_EQ(right.path, "/pixels");
  for (const std::string& path :
       {std::string("/pixels"), std::string("/"), std::string(), "/" + open.token + "0/pixels",
        "/" + open.token.substr(1) + "/pixels", std::string("//pixels")})
    EXPECT_FALSE(answers(request("192.168.1.5:4711", {}, {}, path), open)) << path;
  EXPECT_FALSE(
      answers(request("192.168.1.5:4711", "http://evil.example", {}, "/" + open.token + "/pixels"), open));
}

TEST(RequestCheck, TokensAreLongAndDiffer) {
  const std::string a = random_token();
  EXPECT_EQ(a.size(), 32u);
  EXPECT_NE(a, random_token());
}

TEST(RequestCheck, AddressesOfVersionSixAreInBrackets) {
  EXPECT_EQ((PageAddress{"::1", 80, ""}).url(), "http://[::1]:80/");
}

}  // namespace
}  // namespace kaustik::app
