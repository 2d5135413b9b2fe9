#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <walr/walr_passes.h>

#include "tests/integration/call_check.h"
#include "tests/integration/random_device.h"

namespace walr::test {

/// A handle that the library never makes: its handles count up from 1.
template <typename Handle>
Handle wildHandle(Dice& dice) {
  return reinterpret_cast<Handle>((std::uintptr_t{1} << 40) + dice.below(1000));
}

/// A denoiser and what a model of the API knows of it.
struct ModelledDenoiser {
  WalrDenoiser handle = nullptr;
  const WalrPassType* type = nullptr;
  bool lint = false;
  bool counters = false;
  bool rectangle = false;
  bool orthographic = false;
  std::vector<WalrLightKind> lights;
  bool allocates = false;  ///< With an allocator that fails now and then.
  bool changed = false;    ///< Its settings may be at odds with each other, or with its view.
};

/// Passes and what a model of the API knows of them.
struct ModelledPasses {
  WalrPasses handle = nullptr;
  const WalrPassList* list = nullptr;
  std::string method;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<WalrLightKind> lights;
  bool rectangle = false;
  bool orthographic = false;
  bool lint = false;
  bool counters = false;
  bool recordable = false;  ///< They have a device.
  bool allocates = false;   ///< With an allocator that fails now and then.
  bool begun = false;       ///< There are constants of a frame.
  bool hadFrame = false;
};

/// Records into a real command buffer.
class FrameRecorder {
 public:
  virtual ~FrameRecorder() = default;
  virtual void record(Dice& dice, CallCheck& check, const ModelledDenoiser& denoiser) = 0;
  virtual void recordPass(Dice& dice, CallCheck& check, const ModelledPasses& passes) = 0;
};

/// Calls functions of the C API in random order, with right and wrong arguments, and compares each result with what a
/// model of the API expects.
class RandomCalls {
 public:
  struct Host {
    RandomHost vulkan;                   ///< Without a device no denoiser can be created, and passes are only listed.
    FrameRecorder* recorder = nullptr;   ///< Null: no frame is recorded.
    std::span<const WalrPasses> shared;  ///< Other threads use and destroy these at the same time.
  };

  RandomCalls(std::uint64_t seed, const Host& host);
  /// Destroys all objects that are left.
  ~RandomCalls();
  RandomCalls(const RandomCalls&) = delete;
  RandomCalls& operator=(const RandomCalls&) = delete;

  void run(std::uint32_t calls);
  [[nodiscard]] const CallCheck& check() const { return check_; }

 private:
  template <typename Handle, typename Model>
  struct Pool {
    std::vector<Model> live;
    std::vector<Handle> dead;
  };
  /// A handle with its model, which is null unless the handle is live.
  template <typename Handle, typename Model>
  struct Picked {
    Handle handle = nullptr;
    Model* model = nullptr;
  };
  using PickedPasses = Picked<WalrPasses, ModelledPasses>;
  using PickedDenoiser = Picked<WalrDenoiser, ModelledDenoiser>;

  template <typename Handle, typename Model>
  Picked<Handle, Model> pick(Pool<Handle, Model>& pool, std::span<const Handle> shared, Expectation& expected);
  PickedPasses pickPasses(Expectation& expected);
  PickedDenoiser pickDenoiser(Expectation& expected);

  void call();
  void callNothing();
  void callPasses();
  void callDenoiser();
  void createPasses();
  void destroyPasses();
  void listPasses();
  void inspect(const WalrPassList& list);
  void continuePasses();
  void beginFrame();
  void frameConstants();
  void recordPass();
  void passResults();
  void createDenoiser();
  void destroyDenoiser();
  void changeSetting();
  void readSetting();
  void resize();
  void usePreset();
  void requirements();
  void denoiserResults();
  void denoiserCounts();
  void chooseView();
  void record();
  void prepare();
  [[nodiscard]] std::string settingOf(WalrDenoiser denoiser, const char* name);

  Dice dice_;
  Host host_;
  CallCheck check_;
  std::vector<const WalrPassType*> types_;
  std::vector<const WalrPassType*> methods_;
  Pool<WalrPasses, ModelledPasses> passes_;
  Pool<WalrDenoiser, ModelledDenoiser> denoisers_;
};

}  // namespace walr::test
