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
  // A tunnel may end at another port.
  for (const char* host : {"127.0.0.1:4711", "localhost:4711", "[::1]:4711", "localhost:8080", "localhost"})
    EXPECT_TRUE(answers(request(host), local)) << host;
  // Names that someone lets point to 127.0.0.1, and none.
  for (const char* host : {"evil.example:4711", "127.0.0.1.evil.example:4711", "127.0.0.12:4711",
                           "localhostile", "", "localhost:4711@evil.example", "localhost:4711:x"})
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

// A link in a mail or a chat opens the page, and does nothing else.
TEST(RequestCheck, LinksOfOthersOpenThePage) {
  const PageAddress local{"127.0.0.1", 4711};
  HttpRequest link = request("localhost:4711", "", "cross-site", "/");
  EXPECT_FALSE(answers(link, local)) << "a script of another page";
  link.fetch_mode = "navigate";
  EXPECT_TRUE(answers(link, local));
  link.method = "POST";
  EXPECT_FALSE(answers(link, local));
  link.method = "GET", link.path = "/save";
  EXPECT_FALSE(answers(link, local));
}

TEST(RequestCheck, OtherMachinesNeedTheToken) {
  const PageAddress open{"192.168.1.5", 4711, random_token()};
  EXPECT_EQ(open.url(), "http://192.168.1.5:4711/" + open.token + "/");
  HttpRequest right = request("192.168.1.5:4711", {}, {}, "/" + open.token + "/pixels");
  EXPECT_FALSE(refusal(&right, open));
  EXPECT_EQ(right.path, "/pixels");
  for (const std::string& path :
       {std::string("/pixels"), std::string("/"), std::string(), "/" + open.token + "0/pixels",
        "/" + open.token.substr(1) + "/pixels", std::string("//pixels"), "." + open.token + "/pixels"})
    EXPECT_FALSE(answers(request("192.168.1.5:4711", {}, {}, path), open)) << path;
  HttpRequest without_slash = request("192.168.1.5:4711", {}, {}, "/" + open.token);
  const auto redirection = refusal(&without_slash, open);
  ASSERT_TRUE(redirection);
  EXPECT_EQ(redirection->status, 308);
  EXPECT_EQ(redirection->headers.at(0).second, "/" + open.token + "/");
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
