#include <gtest/gtest.h>

#include <sstream>

#include "common/mcap/reader.hpp"
#include "common/mcap/spill.hpp"
#include "common/mcap/writer.hpp"
#include "tests/support/seed.hpp"

namespace interlace::mcap {
namespace {

Bytes bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

/// Two channels, ten messages in two chunks, an attachment and a table.
std::string sample(bool closed = true) {
  std::ostringstream out;
  Writer writer{out, "test"};
  writer.add(Attachment{5, "cell.yaml", "application/yaml", "cell: x\n"});
  writer.add(Metadata{"interlace", {{"fingerprint", "1f"}, {"version", "0.1.0"}}});
  const auto schema = writer.add_schema("interlace/msg/Point", "ros2msg", "float64 x\n");
  const auto a = writer.add_channel(schema, "x/a", "cdr");
  const auto b = writer.add_channel(schema, "x/b", "cdr");
  for (std::uint64_t i = 0; i < 10; ++i) {
    writer.write(i % 3 == 0 ? a : b, 100 + i, 90 + i, bytes("message " + std::to_string(i)));
    if (i == 4) writer.flush();
  }
  if (closed) writer.close();
  return out.str();
}

struct Found {
  std::vector<Message> messages;
  std::optional<std::string> error;
  bool cut_off = false;
};

Found read(const std::string& file) {
  std::istringstream in{file};
  Reader reader{in};
  Found found;
  for (;;) {
    const auto next = reader.next();
    if (!next) found.error = next.error();
    if (!next || !*next) break;
    found.messages.push_back(**next);
  }
  found.cut_off = reader.cut_off();
  return found;
}

TEST(Mcap, GivesBackWhatWasWritten) {
  std::istringstream in{sample()};
  Reader reader{in};
  for (std::uint64_t i = 0; i < 10; ++i) {
    const auto next = reader.next();
    ASSERT_TRUE(next && *next) << next.error();
    EXPECT_EQ((*next)->log_time, 100 + i);
    EXPECT_EQ((*next)->publish_time, 90 + i);
    EXPECT_EQ((*next)->data, bytes("message " + std::to_string(i)));
    EXPECT_EQ(reader.channels().at((*next)->channel).topic, i % 3 == 0 ? "x/a" : "x/b");
    EXPECT_EQ((*next)->sequence, i % 3 == 0 ? i / 3 : i - 1 - i / 3);
  }
  const auto end = reader.next();
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->has_value());
  EXPECT_FALSE(reader.cut_off());
  ASSERT_EQ(reader.attachments().size(), 1);
  EXPECT_EQ(reader.attachments()[0].data, "cell: x\n");
  ASSERT_EQ(reader.metadata().size(), 1);
  EXPECT_EQ(reader.metadata()[0].values.at("fingerprint"), "1f");
  EXPECT_EQ(reader.schemas().begin()->second.text, "float64 x\n");
}

TEST(Mcap, AFileThatWasNotEndedIsReadUpToItsLastWholeChunk) {
  const Found found = read(sample(false));  // the second chunk never left the writer
  EXPECT_FALSE(found.error);
  EXPECT_TRUE(found.cut_off);
  EXPECT_EQ(found.messages.size(), 5);
}

TEST(Mcap, CutOffAnywhereItGivesAPrefixAndNeverAnError) {
  const std::string whole = sample();
  const auto all = read(whole).messages;
  std::size_t most = 0;
  for (std::size_t length = 8; length < whole.size(); ++length) {
    const Found found = read(whole.substr(0, length));
    ASSERT_FALSE(found.error) << length << ": " << *found.error;
    ASSERT_GE(found.messages.size(), most) << length;
    most = found.messages.size();
    for (std::size_t i = 0; i < most; ++i) ASSERT_EQ(found.messages[i].data, all[i].data);
  }
  EXPECT_EQ(most, 10);
}

TEST(Mcap, ChangedBytesAreRefusedOrReadButNeverMore) {
  const std::string whole = sample();
  test::Seed seed;
  for (int i = 0; i < 20'000; ++i) {
    std::string changed = whole;
    for (std::size_t n = 1 + seed.below(3); n > 0; --n) changed[seed.below(changed.size())] = static_cast<char>(seed.below(256));
    const Found found = read(changed);
    ASSERT_TRUE(!found.error || !found.error->empty());
    ASSERT_LE(found.messages.size(), 20);
  }
}

TEST(Mcap, SaysWhatIsWrong) {
  EXPECT_EQ(read("").error, "byte 0: not an MCAP file");
  EXPECT_EQ(read("a text file, nothing else").error, "byte 0: not an MCAP file");
  std::string huge = sample().substr(0, 8) + std::string("\x06\xff\xff\xff\xff\xff\xff\xff\x7f", 9);
  EXPECT_EQ(read(huge).error, "byte 8: a record of 9223372036854775807 bytes, at most 268435456 are read");
}

TEST(Mcap, AChangedByteOfAChunkIsNoticedAndThePlaceNamed) {
  const std::string whole = sample();
  const auto at = whole.find("message 7");
  std::string changed = whole;
  changed[at] = 'M';
  const Found found = read(changed);
  ASSERT_TRUE(found.error);
  EXPECT_EQ(found.messages.size(), 5) << "the chunk before is whole";
  EXPECT_NE(found.error->find("a chunk's checksum does not agree"), std::string::npos) << *found.error;
  EXPECT_EQ(found.error->rfind("byte ", 0), 0);
  EXPECT_LT(std::stoul(found.error->substr(5)), at);
}

TEST(Mcap, WhatWaitsForTheEndOfAFileComesBackInOrder) {
  Spill spill;
  EXPECT_TRUE(spill.drain([](const Bytes&) { FAIL() << "nothing was added"; }));
  std::string added, taken;
  for (int i = 0; i < 50'000; ++i) {
    const std::string piece = "chunk " + std::to_string(i) + '\n';
    added += piece;
    spill.add(bytes(piece));
  }
  EXPECT_TRUE(spill.drain([&](const Bytes& piece) { taken.append(piece.begin(), piece.end()); }));
  EXPECT_EQ(taken, added);
}

TEST(Mcap, AFullDiskIsNoticed) {
  std::ostringstream out;
  Writer writer{out, "test"};
  const auto channel = writer.add_channel(writer.add_schema("s", "ros2msg", ""), "t", "cdr");
  EXPECT_TRUE(writer.ok());
  out.setstate(std::ios::badbit);
  writer.write(channel, 1, 1, bytes("x"));
  writer.flush();
  EXPECT_FALSE(writer.ok());
}

}  // namespace
}  // namespace interlace::mcap
