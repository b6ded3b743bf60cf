#include "server/metrics/http_request.hpp"

#include <gtest/gtest.h>

#include <random>

namespace genio {
namespace {

using enum HttpAnswer;

HttpAnswer answer_to(const std::string& request) { return judge_http(request).answer; }

TEST(HttpRequest, AScraperIsAnswered) {
  for (const char* request :
       {"GET /metrics HTTP/1.1\r\nHost: 127.0.0.1:7701\r\nAccept: text/plain\r\n\r\n",
        "GET /metrics HTTP/1.1\r\nhOST:localhost\r\n\r\n", "GET /metrics HTTP/1.0\r\n\r\n",
        "GET /metrics?a=b HTTP/1.1\r\nHost: LocalHost:1\r\n\r\n",
        "GET /metrics HTTP/1.1\r\nHost: 127.0.0.2\r\n\r\nmore that came"})
    EXPECT_EQ(answer_to(request), metrics) << request;
  EXPECT_TRUE(judge_http("HEAD /metrics HTTP/1.1\r\n\r\n").head);
}

TEST(HttpRequest, ARequestIsWaitedForUntilItsEnd) {
  const std::string whole = "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n";
  for (size_t k = 0; k < whole.size(); ++k) EXPECT_EQ(answer_to(whole.substr(0, k)), not_yet);
  EXPECT_EQ(answer_to(whole), metrics);
}

TEST(HttpRequest, WhatIsOtherwiseIsToldWhy) {
  const std::pair<const char*, HttpAnswer> cases[] = {
      {"GET / HTTP/1.1\r\n\r\n", unknown_path},
      {"GET /metricsx HTTP/1.1\r\n\r\n", unknown_path},
      {"POST /metrics HTTP/1.1\r\n\r\n", unknown_method},
      {"get /metrics HTTP/1.1\r\n\r\n", unknown_method},
      {"GET /metrics HTTP/2\r\n\r\n", malformed},
      {"GET /metrics\r\n\r\n", malformed},
      {"GET http://x/metrics HTTP/1.1\r\n\r\n", malformed},
      {"GET  /metrics HTTP/1.1\r\n\r\n", malformed},
      {"\r\n\r\n", malformed},
      {"GET /metrics HTTP/1.1\r\nno colon\r\n\r\n", malformed},
      {"GET /metrics HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n", malformed}};
  for (const auto& [request, answer] : cases) EXPECT_EQ(answer_to(request), answer) << request;
}

TEST(HttpRequest, APageUnderAnotherNameReadsNothing) {
  for (const char* host : {"evil.example", "evil.example:7701", "127.0.0.1.evil.example",
                           "localhost.evil.example", "", "192.168.1.1", "1270.0.0.1"})
    EXPECT_EQ(answer_to(std::string("GET /metrics HTTP/1.1\r\nHost: ") + host + "\r\n\r\n"),
              other_host)
        << host;
}

TEST(HttpRequest, HeadersEndSomewhere) {
  const std::string line = "GET /metrics HTTP/1.1\r\nA: ";
  EXPECT_EQ(answer_to(line + std::string(longest_http_request, 'x')), too_long);
  EXPECT_EQ(answer_to(line + std::string(longest_http_request, 'x') + "\r\n\r\n"), too_long);
  const std::string most(longest_http_request - line.size() - 4, 'x');
  EXPECT_EQ(answer_to(line + most), not_yet);
  EXPECT_EQ(answer_to(line + most + "\r\n\r\n"), metrics);
}

TEST(HttpRequest, AnyBytesAreJudged) {
  std::mt19937 random(3);
  const std::string good = "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n";
  for (int k = 0; k < 20000; ++k) {
    std::string bytes = good;
    for (int changes = 1 + int(random() % 4); changes > 0; --changes)
      bytes[random() % bytes.size()] = char(random());
    const std::string response = http_response(judge_http(bytes), &good);
    ASSERT_TRUE(response.starts_with("HTTP/1.1 "));
  }
}

TEST(HttpResponse, SaysItsLengthAndItsType) {
  const std::string text = "a 1\n";
  const std::string whole = http_response({metrics}, &text);
  EXPECT_TRUE(whole.starts_with("HTTP/1.1 200 OK\r\n")) << whole;
  EXPECT_NE(whole.find("\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\n"),
            std::string::npos);
  EXPECT_NE(whole.find("\r\nContent-Length: 4\r\n"), std::string::npos);
  EXPECT_TRUE(whole.ends_with("\r\n\r\na 1\n"));
  EXPECT_EQ(http_response({metrics, true}, &text), whole.substr(0, whole.size() - 4));
  EXPECT_TRUE(http_response({metrics}, nullptr).starts_with("HTTP/1.1 503 "));
  EXPECT_NE(http_response({unknown_method}, &text).find("\r\nAllow: GET, HEAD\r\n"),
            std::string::npos);
}

}  // namespace
}  // namespace genio
