// Compiled messages go by their binary form: it must say what reflection says.
#include "seautils/schema/message.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

using namespace seautils;
using google::protobuf::FileDescriptorProto;

namespace {

/// A message of a compiled class with texts, enumerations, sub-messages and lists: what descriptor.proto
/// says of itself.
FileDescriptorProto sample() {
    FileDescriptorProto message;
    FileDescriptorProto::descriptor()->file()->CopyTo(&message);
    return message;
}

}  // namespace

TEST(SchemaBridge, ReadsWhatReflectionReads) {
    const FileDescriptorProto message = sample();
    schema::LayoutSet layouts;
    const schema::Layout& layout = layouts.of(*FileDescriptorProto::descriptor());
    schema::Values by_reflection, by_bridge;
    schema::from_message(message, layout, by_reflection);
    schema::MessageBridge().read(message, layout, by_bridge);
    EXPECT_TRUE(schema::equal(by_reflection, by_bridge));
    EXPECT_TRUE(by_bridge[0].present);
}

TEST(SchemaBridge, WritesWhatReflectionWrites) {
    const FileDescriptorProto message = sample();
    schema::LayoutSet layouts;
    schema::Values values;
    schema::from_message(message, layouts.of(*FileDescriptorProto::descriptor()), values);
    FileDescriptorProto back;
    back.set_name("must be cleared");
    back.add_dependency("this too");
    schema::MessageBridge().write(values, back);
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(message, back));
}

TEST(SchemaBridge, MessagesKnownAtRunTimeOnlyPassToo) {
    const FileDescriptorProto message = sample();
    google::protobuf::DynamicMessageFactory factory;
    const std::unique_ptr<google::protobuf::Message> dynamic(
        factory.GetPrototype(FileDescriptorProto::descriptor())->New());
    ASSERT_TRUE(dynamic->ParseFromString(message.SerializeAsString()));
    schema::LayoutSet layouts;
    const schema::Layout& layout = layouts.of(*FileDescriptorProto::descriptor());
    schema::Values values;
    schema::MessageBridge bridge;
    bridge.read(*dynamic, layout, values);
    dynamic->Clear();
    bridge.write(values, *dynamic);
    EXPECT_EQ(dynamic->SerializeAsString(), message.SerializeAsString());
}
