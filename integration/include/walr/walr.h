/*
 * walr: a real-time denoiser for diffuse indirect light. C11 and C++.
 *
 * A denoiser records its passes, with its own memory and its own barriers between them, into a command buffer of the
 * host's. The host says in which state it hands its images over and in which state it wants them back.
 *
 * Rules that hold everywhere:
 * - Every function that can fail returns a WalrResult; walr_last_error() then says in words what is wrong and what to
 *   do about it. No wrong argument crashes, with the one exception that pointers must point where they claim to.
 * - Structures begin with `struct_size`, which the caller sets to sizeof. A library that is newer than the header that
 *   the caller was built with takes what is missing as zero; one that is older refuses fields it does not know unless
 *   they are zero. Zero is always the usual choice. Structures without `struct_size` never change.
 * - Handles are never reused: a destroyed one is an error, for ever.
 * - A denoiser is for one thread at a time; a call while another thread is inside one is WALR_ERROR_CONCURRENT_USE and
 *   does nothing. Different denoisers are independent.
 * - Matrices are column-major and multiply column vectors. View space is right-handed, the camera looks down -Z.
 *   Pictures have x to the right and y down, in pixels, pixel centres at .5.
 */
#ifndef WALR_WALR_H
#define WALR_WALR_H

#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan_core.h>

#if defined(_WIN32) && defined(WALR_BUILDING_SHARED)
#define WALR_API __declspec(dllexport)
#elif defined(_WIN32) && defined(WALR_SHARED)
#define WALR_API __declspec(dllimport)
#elif defined(__GNUC__)
#define WALR_API __attribute__((visibility("default")))
#else
#define WALR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum WalrResult {
  WALR_SUCCESS = 0,
  WALR_ERROR_INVALID_ARGUMENT = -1, /* Null, out of range, of the wrong size, format, usage or queue family. */
  WALR_ERROR_INVALID_HANDLE = -2,   /* Null, destroyed before, or never made. */
  WALR_ERROR_STRUCT_SIZE = -3,      /* struct_size not set, or of a header that knows more than the library. */
  WALR_ERROR_CONCURRENT_USE = -4,   /* Another thread is using the object. */
  WALR_ERROR_WRONG_ORDER = -5,      /* Something has to be done before. */
  WALR_ERROR_UNSUPPORTED = -6,      /* The device lacks something; the text says what. */
  WALR_ERROR_OUT_OF_MEMORY = -7,
  WALR_ERROR_DEVICE_LOST = -8,
  WALR_ERROR_INTERNAL = -9, /* A fault of the library. */
  WALR_RESULT_MAX = 0x7fffffff
} WalrResult;

/* The library's version, "major.minor.patch". */
WALR_API const char* walr_version(void);
/* Name of a result, for instance "WALR_ERROR_INVALID_HANDLE". */
WALR_API const char* walr_result_name(WalrResult result);
/* What went wrong in the call of this thread that failed last. Valid until the next one fails. Never null. */
WALR_API const char* walr_last_error(void);

/* ---- What there is -------------------------------------------------------------------------------------------- */

typedef enum WalrSettingKind {
  WALR_SETTING_NUMBER = 0,
  WALR_SETTING_INTEGER = 1,
  WALR_SETTING_SWITCH = 2, /* "on" or "off" */
  WALR_SETTING_CHOICE = 3, /* One of `choices`. */
  WALR_SETTING_KIND_MAX = 0x7fffffff
} WalrSettingKind;

typedef struct WalrSetting {
  uint32_t struct_size;
  WalrSettingKind kind;
  const char* name;
  const char* default_value; /* As walr_set_setting takes it. */
  double least;              /* Numbers and integers. */
  double most;
  const char* const* choices; /* Switches and choices: all values. */
  uint32_t choice_count;
  uint32_t reserved;
  const char* unit;        /* "frames", "pixels", "fraction of depth"; empty for a pure number. */
  const char* description; /* One line. */
  const char* source;      /* Paper and section, or "measured". */
} WalrSetting;

typedef struct WalrPort {
  uint32_t struct_size;
  VkBool32 output;
  const char* name;
  VkBool32 optional;    /* Inputs: not read with default settings. */
  VkBool32 buffer;      /* A buffer, not an image. */
  VkFormat format;      /* The usual format; images only. */
  VkFlags image_usage;  /* Union of what all passes do with it; images only. */
  VkFlags buffer_usage; /* The same for buffers. */
  uint32_t reserved;
  uint64_t buffer_size;    /* Bytes; buffers only. */
  const char* description; /* May be empty. */
} WalrPort;

/* A stage, or a whole denoising method: something made of passes, with ports and settings. walr_create_passes makes
 * either, walr_create_denoiser only whole methods. */
typedef struct WalrPassType {
  uint32_t struct_size;
  VkBool32 method; /* A whole method. */
  const char* name;
  const char* description;
  const WalrPort* const* ports;
  const WalrSetting* const* settings;
  const char* const* presets;
  const char* const* passes; /* Names of its passes with default settings. */
  uint32_t port_count;
  uint32_t setting_count;
  uint32_t preset_count;
  uint32_t pass_count;
} WalrPassType;

/* All pass types. No device is needed. What is returned is valid for as long as the library is loaded. */
WALR_API uint32_t walr_pass_type_count(void);
/* Null where there is no such type. */
WALR_API const WalrPassType* walr_pass_type(uint32_t index);

/* ---- The device ------------------------------------------------------------------------------------------------ */

/*
 * The host's device. It must have been created with the features synchronization2 (Vulkan 1.3, or
 * VK_KHR_synchronization2) and shaderStorageImageExtendedFormats. No Vulkan function is linked to: all come from
 * `get_instance_proc_addr`.
 */
typedef struct WalrDevice {
  uint32_t struct_size;
  uint32_t queue_family; /* Family of the one queue that command buffers are submitted to; must do compute. */
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkDevice device;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  const VkAllocationCallbacks* allocator; /* Host memory; optional. What it points to is copied. */
} WalrDevice;

/* WALR_ERROR_UNSUPPORTED where the device will not do; the text names everything that it lacks. */
WALR_API WalrResult walr_check_device(const WalrDevice* device);

/* ---- A denoiser ------------------------------------------------------------------------------------------------ */

typedef struct WalrDenoiser_T* WalrDenoiser;

typedef enum WalrSpace { WALR_SPACE_VIEW = 0, WALR_SPACE_WORLD = 1, WALR_SPACE_MAX = 0x7fffffff } WalrSpace;

typedef enum WalrMotionUnit {
  WALR_MOTION_PIXELS = 0,
  WALR_MOTION_PICTURES = 1, /* 1 is the picture's whole width or height ("UV"). */
  WALR_MOTION_UNIT_MAX = 0x7fffffff
} WalrMotionUnit;

typedef enum WalrMotionDepth {
  WALR_MOTION_DEPTH_GIVEN = 0,        /* The motion image's third channel: previous minus current view depth. */
  WALR_MOTION_DEPTH_STATIC_SCENE = 1, /* Computed from the cameras; right where only the camera moves. */
  WALR_MOTION_DEPTH_REVERSED = 2,     /* The third channel, as current minus previous view depth. */
  WALR_MOTION_DEPTH_MAX = 0x7fffffff
} WalrMotionDepth;

typedef enum WalrDepth {
  WALR_DEPTH_LINEAR = 0,          /* Distance along the view axis, above 0. */
  WALR_DEPTH_NEGATIVE_LINEAR = 1, /* z of view space. */
  /* z over w of Vulkan's clip space, as row z of WalrCamera::projection makes it: 0 near or far, finite or infinite. */
  WALR_DEPTH_DEVICE = 2,
  WALR_DEPTH_MAX = 0x7fffffff
} WalrDepth;

typedef enum WalrNormals {
  WALR_NORMALS_SIGNED = 0,              /* Three channels in -1..1; all zero is sky. */
  WALR_NORMALS_UNSIGNED = 1,            /* Three channels in 0..1 that stand for -1..1; all zero is sky. */
  WALR_NORMALS_OCTAHEDRAL_SIGNED = 2,   /* Octahedral map, pole on +z, two channels in -1..1; depth alone tells sky. */
  WALR_NORMALS_OCTAHEDRAL_UNSIGNED = 3, /* The same in 0..1. */
  WALR_NORMALS_MAX = 0x7fffffff
} WalrNormals;

/* How the host's images are to be read. Stated once, when the denoiser is made. What differs from the usual, which is
 * zero, costs one small pass an image. */
typedef struct WalrConventions {
  uint32_t struct_size;
  WalrSpace normal_space;
  WalrMotionUnit motion_unit;
  WalrMotionDepth motion_depth;
  /* Multiplies motion.xy, after which previous = current + motion, y down. Zero stands for 1. Use -1 where the host's
   * motion is current - previous, and -1 for y where its y is up. */
  float motion_scale[2];
  WalrDepth depth;
  WalrNormals normals;
  VkBool32 pre_exposed;     /* Lighting is multiplied by WalrFrame::pre_exposure, and the result is to be, too. */
  VkBool32 motion_jittered; /* motion.xy is between the jittered images. Else it holds no jitter. */
  /* Images may be larger than what is denoised, a rectangle that starts at WalrFrame::offset and whose size
   * (walr_resize) may change from frame to frame: history goes on. Motion is in units of the frame's own rectangle:
   * what stays where it is in the picture has none, whatever size the last frame had. So is each jitter. */
  VkBool32 rectangle;
  uint32_t reserved;
} WalrConventions;

typedef enum WalrLogLevel {
  WALR_LOG_INFO = 0,
  WALR_LOG_WARNING = 1,
  WALR_LOG_ERROR = 2,
  WALR_LOG_LEVEL_MAX = 0x7fffffff
} WalrLogLevel;

/* Called on the thread that calls the library, which must not be called from within. */
typedef void (*WalrLog)(void* user, WalrLogLevel level, const char* text);

typedef struct WalrDenoiserInfo {
  uint32_t struct_size;
  uint32_t frames_in_flight; /* Frames that may be recorded before the GPU has finished the first; 0 stands for 2. */
  const WalrDevice* device;
  const char* method; /* Null stands for "walr". */
  const char* preset; /* Null stands for the method's first. */
  uint32_t width;     /* Pixels. */
  uint32_t height;
  const WalrConventions* conventions; /* Null stands for all zero. */
  /* Formats of the host's images; VK_FORMAT_UNDEFINED stands for the usual one, see WalrPort::format. Others must be
   * sampled as floats and have the channels. */
  VkFormat lighting_format;
  VkFormat depth_format;
  VkFormat normal_format;
  VkFormat motion_format;
  VkFormat albedo_format;
  VkBool32 timestamps; /* Measure the GPU time of every pass, where the queue family can. */
  WalrLog log;         /* Optional. */
  void* log_user;
  VkFormat object_id_format; /* Of WalrFrame::object_id, unsigned integers; VK_FORMAT_UNDEFINED: there is none. */
  VkBool32 lint;             /* Check the inputs of every frame: see walr_get_findings. For debugging; costs a pass. */
  /* In which all pipelines are looked up and kept; optional. It must live as long as what is made here. A host that
   * saves what vkGetPipelineCacheData returns and makes the cache from it at the next start compiles nothing then. */
  VkPipelineCache pipeline_cache;
} WalrDenoiserInfo;

/* No Vulkan object is made yet; see walr_prepare. */
WALR_API WalrResult walr_create_denoiser(const WalrDenoiserInfo* info, WalrDenoiser* denoiser);
/* The GPU must have finished everything recorded. */
WALR_API WalrResult walr_destroy_denoiser(WalrDenoiser denoiser);

/*
 * The next three take effect with the next walr_prepare or walr_record. Nothing has to be waited for: what frames in
 * flight use lives on until they are finished.
 *
 * - A setting that changes only numbers inside the passes, as most do, keeps the history and makes nothing: no image,
 * no memory, and a pipeline only where a shader is to be specialized for a value that it has not had yet.
 * - A setting that changes passes or textures makes new images and memory, and pipelines for new passes only. A history
 *   goes on, with its length, where the new passes keep one of its name and format; others start anew.
 * - A new size makes new images and memory, but no pipelines. The history goes on with WalrConventions::rectangle, and
 *   is dropped without.
 */
WALR_API WalrResult walr_resize(WalrDenoiser denoiser, uint32_t width, uint32_t height);
WALR_API WalrResult walr_set_setting(WalrDenoiser denoiser, const char* name, const char* value);
/* Replaces all settings. */
WALR_API WalrResult walr_use_preset(WalrDenoiser denoiser, const char* name);

/* Present value of a setting as text, with its terminating zero.
 * size: in: bytes at `value`; out: bytes needed. `value` may be null. */
WALR_API WalrResult walr_get_setting(WalrDenoiser denoiser, const char* name, char* value, size_t* size);

/* Make all memory and pipelines now, at a time of the host's choice, and not with the next frame. */
WALR_API WalrResult walr_prepare(WalrDenoiser denoiser);

/* ---- Images ---------------------------------------------------------------------------------------------------- */

/* What the host must make an image with. */
typedef struct WalrImageRequirements {
  uint32_t struct_size;
  VkBool32 required; /* Whether the denoiser touches it with its present settings. */
  VkFormat format;
  VkImageUsageFlags usage; /* Union over all passes. */
  uint32_t width;          /* Exactly, or, with WalrConventions::rectangle, at least. */
  uint32_t height;
} WalrImageRequirements;

/* port: "lighting", "depth", "normal", "motion", "albedo", "object_id" or "denoised". Needs no image and no
 * walr_prepare. */
WALR_API WalrResult walr_get_image_requirements(WalrDenoiser denoiser, const char* port,
                                                WalrImageRequirements* requirements);

/* State of an image between the host's work and the denoiser's, as in a VkImageMemoryBarrier2. */
typedef struct WalrImageState {
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
  VkImageLayout layout;
  uint32_t reserved;
} WalrImageState;

/* An image of the host's. Views of it are made once for each identity and kept until walr_forget_image. */
typedef struct WalrImage {
  uint32_t struct_size;
  uint32_t queue_family; /* That owns it: the device's, or VK_QUEUE_FAMILY_IGNORED where that needs no saying. */
  VkImage image;
  /* A number that no other image of the host has or will have: handles are recycled. 0 stands for the handle, for
   * hosts that call walr_forget_image before they destroy an image. */
  uint64_t identity;
  VkFormat format;
  VkImageUsageFlags usage; /* That it was made with. */
  uint32_t width;
  uint32_t height;
  WalrImageState acquire; /* In which it comes: who wrote it last. */
  /* In which it goes back: who uses it next. With VK_IMAGE_LAYOUT_UNDEFINED, inputs go back in the layout in which they
   * came and the output in GENERAL, all ready for anything that follows on the queue. */
  WalrImageState release;
} WalrImage;

/* The state in which the last walr_record left an image. */
WALR_API WalrResult walr_get_release_state(WalrDenoiser denoiser, const char* port, WalrImageState* state);

/* Destroy the views of an image. Call before the image is destroyed, once the GPU has finished with it. */
WALR_API WalrResult walr_forget_image(WalrDenoiser denoiser, VkImage image, uint64_t identity);

/* ---- Frames ---------------------------------------------------------------------------------------------------- */

typedef struct WalrCamera {
  float view[16];       /* World to view space. */
  float projection[16]; /* View to clip space, perspective, without jitter, x right, y up. Row z is used with
                         * WALR_DEPTH_DEVICE only. */
  float jitter[2];      /* Pixels, y down: sample position minus pixel centre. */
} WalrCamera;

typedef enum WalrFrameFlags {
  WALR_FRAME_RESET_HISTORY = 1, /* Camera cut, or frames were skipped: nothing of the past is of use. */
  WALR_FRAME_FLAGS_MAX = 0x7fffffff
} WalrFrameFlags;

typedef struct WalrFrame {
  uint32_t struct_size;
  uint32_t flags; /* WalrFrameFlags */
  const WalrImage* lighting;
  const WalrImage* depth;
  const WalrImage* normal;
  const WalrImage* motion;
  const WalrImage* albedo;
  const WalrImage* denoised;
  const WalrCamera* camera;
  const WalrCamera* previous_camera; /* Null stands for the camera of the frame recorded last. */
  float sky_depth;                   /* Scene units: a view depth from here on is sky. 0 stands for 1e9. */
  float pre_exposure;                /* With WalrConventions::pre_exposed; 0 stands for 1. */
  const WalrImage* object_id;        /* Optional, see WalrDenoiserInfo::object_id_format. */
  uint32_t offset[2];                /* With WalrConventions::rectangle: its first pixel in all images, y down. */
} WalrFrame;

/*
 * Record one frame.
 *
 * Recorded frames must be submitted in the order of recording, all to the one queue, and before a frame is recorded the
 * GPU must have finished the one recorded `frames_in_flight` frames earlier. Nothing is recorded where an error is
 * returned.
 *
 * command_buffer: in the recording state, outside of a render pass. Its bound compute pipeline, descriptor set 0 and
 * push constants are changed.
 */
WALR_API WalrResult walr_record(WalrDenoiser denoiser, VkCommandBuffer command_buffer, const WalrFrame* frame);

/* Drop all history: the next frame starts anew. */
WALR_API WalrResult walr_reset_history(WalrDenoiser denoiser);

/* ---- Figures --------------------------------------------------------------------------------------------------- */

typedef struct WalrMemory {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t allocated;           /* Bytes of device memory taken from the driver. */
  uint64_t persistent;          /* Histories. */
  uint64_t transient;           /* What everything else needs besides, sharing memory also with histories. */
  uint64_t transient_unaliased; /* The same if nothing shared, as where every pass is the host's. */
  uint64_t transient_least;     /* No arrangement could do with less. */
  uint64_t retired;             /* Of what was replaced, and is in use by frames in flight. */
} WalrMemory;

/* Needs walr_prepare or walr_record before. */
WALR_API WalrResult walr_get_memory(WalrDenoiser denoiser, WalrMemory* memory);

typedef struct WalrPassTime {
  const char* name; /* Valid until settings or size change. */
  double milliseconds;
} WalrPassTime;

/* GPU times of the last frame that the GPU has finished; none without WalrDenoiserInfo::timestamps.
 * count: in: room at `times`; out: number of passes. `times` may be null. */
WALR_API WalrResult walr_get_timings(WalrDenoiser denoiser, uint32_t* count, WalrPassTime* times);

/* Something that looks wrong in the host's images or matrices. Valid until the next call that takes the denoiser. */
typedef struct WalrFinding {
  const char* name;    /* For programs: "motion-x-direction". */
  const char* what;    /* What was found, with figures. */
  const char* cause;   /* What it most likely comes from. */
  const char* way_out; /* What to do about it. */
} WalrFinding;

/* What the frames that the GPU has finished say of the host's images and matrices, with WalrDenoiserInfo::lint. A frame
 * is looked at when the one `frames_in_flight` after it is recorded; what is found for the first time is also logged.
 * A new size starts anew, unless WalrConventions::rectangle is stated.
 * count: in: room at `findings`; out: number of findings. `findings` may be null. */
WALR_API WalrResult walr_get_findings(WalrDenoiser denoiser, uint32_t* count, WalrFinding* findings);

#ifdef __cplusplus
}
#endif
#endif
