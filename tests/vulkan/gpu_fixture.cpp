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

void closeDevice() {
  validated.reset();
  failOnMessages();
}

/// Closes the device after the last test of the program.
class DeviceOfTheProgram : public testing::Environment {
 public:
  void TearDown() override { closeDevice(); }
};
[[maybe_unused]] const testing::Environment* const deviceOfTheProgram =
    testing::AddGlobalTestEnvironment(new DeviceOfTheProgram);

}  // namespace

void GpuTest::SetUp() {
  if (!validated) validated.emplace(messages);
}

void GpuTest::TearDown() {
  failOnMessages();
  if (HasFailure()) closeDevice();
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
