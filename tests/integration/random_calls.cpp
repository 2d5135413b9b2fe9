#include "tests/integration/random_calls.h"

#include "tests/integration/random_arguments.h"

namespace walr::test {
RandomCalls::RandomCalls(std::uint64_t seed, const Host& host) : dice_(seed), host_(host) {
  for (std::uint32_t i = 0; i < walr_pass_type_count(); ++i) {
    types_.push_back(walr_pass_type(i));
    if (types_.back()->method != 0) methods_.push_back(types_.back());
  }
}

RandomCalls::~RandomCalls() {
  for (const ModelledPasses& passes : passes_.live) walr_destroy_passes(passes.handle);
  for (const ModelledDenoiser& denoiser : denoisers_.live) walr_destroy_denoiser(denoiser.handle);
}

void RandomCalls::run(std::uint32_t calls) {
  for (std::uint32_t i = 0; i < calls; ++i) call();
}

template <typename Handle, typename Model>
RandomCalls::Picked<Handle, Model> RandomCalls::pick(Pool<Handle, Model>& pool, std::span<const Handle> shared,
                                                     Expectation& expected) {
  if (!shared.empty() && dice_.oneIn(2)) {
    expected.isShared();
    return {shared[dice_.below(shared.size())], nullptr};
  }
  if (!pool.live.empty() && !dice_.oneIn(8)) {
    Model& model = pool.live[dice_.below(pool.live.size())];
    return {model.handle, &model};
  }
  expected.fails(WALR_ERROR_INVALID_HANDLE);
  if (!pool.dead.empty() && !dice_.oneIn(3)) return {pool.dead[dice_.below(pool.dead.size())], nullptr};
  return {dice_.oneIn(2) ? nullptr : wildHandle<Handle>(dice_), nullptr};
}

RandomCalls::PickedPasses RandomCalls::pickPasses(Expectation& expected) {
  return pick(passes_, host_.shared, expected);
}

RandomCalls::PickedDenoiser RandomCalls::pickDenoiser(Expectation& expected) {
  return pick(denoisers_, {}, expected);
}

void RandomCalls::call() {
  if (dice_.oneIn(24)) return callNothing();
  // Without a device there are only passes.
  if (dice_.oneIn(host_.vulkan.device != nullptr ? 2 : 16)) {
    callDenoiser();
  } else {
    callPasses();
  }
}

/// Functions that take no handle.
void RandomCalls::callNothing() {
  Expectation expected;
  switch (dice_.below(4)) {
    case 0: {
      const bool withoutDevice = dice_.oneIn(8);
      const RandomDevice device(dice_, expected, host_.vulkan);
      if (withoutDevice) expected.fails();
      check_("walr_check_device", expected, {"WalrDevice", "WalrMemoryCallbacks", "queue famil", "created without"},
             [&] { return walr_check_device(withoutDevice ? nullptr : device.get()); });
      return;
    }
    case 1: {
      const RandomInfo info(dice_, expected, methods_, host_.vulkan);
      if (host_.vulkan.device == nullptr) expected.fails();
      Grown<WalrMemory> memory;
      memory.value.struct_size = dice_.oneIn(8) ? dice_.of({0U, 8U, 1U << 20}) : sizeof(memory.value);
      if (memory.value.struct_size != sizeof(memory.value)) expected.fails();
      const bool withoutResult = dice_.oneIn(16);
      if (withoutResult) expected.fails();
      expected.mayFail();
      check_("walr_query_memory", expected, kInfoNames,
             [&] { return walr_query_memory(info.get(), withoutResult ? nullptr : &memory.value); });
      return;
    }
    case 2:
      if (walr_pass_type(walr_pass_type_count() + dice_.below(1000)) != nullptr) {
        check_.fault("there is a pass type too many");
      }
      return;
    default:
      if (*walr_result_name(static_cast<WalrResult>(int(dice_.below(40)) - 20)) == '\0' || *walr_version() == '\0') {
        check_.fault("a name is empty");
      }
  }
}

}  // namespace walr::test
