#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <walr/walr_passes.h>

#include "tests/integration/call_check.h"

namespace walr::test {

/// A denoiser and what a model of the API knows of it.
struct ModelledDenoiser {
  WalrDenoiser handle = nullptr;
  const WalrPassType* type = nullptr;
  bool lint = false;
  bool changed = false;  ///< Its settings may be at odds with each other.
};

/// Records frames into a real command buffer.
class FrameRecorder {
 public:
  virtual ~FrameRecorder() = default;
  virtual void record(Dice& dice, CallCheck& check, const ModelledDenoiser& denoiser) = 0;
};

/// Calls functions of the C API in random order, with right and wrong arguments, and compares each result with what a
/// model of the API expects.
class RandomCalls {
 public:
  struct Host {
    const WalrDevice* device = nullptr;  ///< Null: no denoiser can be created, and passes are only listed.
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
  struct ModelledPasses {
    WalrPasses handle = nullptr;
    const WalrPassList* list = nullptr;
    std::string method;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool rectangle = false;
    bool lint = false;
    bool begun = false;  ///< There are constants of a frame.
    bool hadFrame = false;
  };

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
  PickedPasses pickPasses(Expectation& expected) { return pick(passes_, host_.shared, expected); }
  PickedDenoiser pickDenoiser(Expectation& expected) { return pick(denoisers_, {}, expected); }

  void call();
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
