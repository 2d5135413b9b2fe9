#include "tests/vulkan/gpu_fixture.h"

#include <optional>

namespace fg::test {
namespace {

vk::InstanceOptions withValidation(vk::MessageLog& log) {
  vk::InstanceOptions options;
  options.applicationName = "walr tests";
  options.validation = true;
  options.sink = log.sink();
  return options;
}

struct ValidatedDevice {
  explicit ValidatedDevice(vk::MessageLog& log)
      : instance(withValidation(log)),
        device(instance, vk::physicalDevices(instance).front(), {}, nullptr, vk::HalfArithmetic::Never) {}

  vk::Instance instance;
  TestDevice device;
};

vk::MessageLog messages;
std::optional<ValidatedDevice> validated;

void failOnMessages() {
  for (const vk::Message& message : messages.take()) ADD_FAILURE() << "validation: " << message.text;
}

}  // namespace

void GpuTest::TearDownTestSuite() {
  validated.reset();
  failOnMessages();
}

void GpuTest::SetUp() {
  if (!validated) validated.emplace(messages);
}

void GpuTest::TearDown() {
  failOnMessages();
  if (HasFailure()) TearDownTestSuite();
}

const vk::Instance& GpuTest::instance() {
  return validated->instance;
}

const TestDevice& GpuTest::device() {
  return validated->device;
}

std::vector<vk::Message> GpuTest::takeMessages() {
  return messages.take();
}

}  // namespace fg::test
