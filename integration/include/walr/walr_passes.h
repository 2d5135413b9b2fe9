/*
 * The passes of a method or of a single stage as plain data, for engines that schedule and record passes themselves:
 * what each pass reads and writes, and all that is needed to run it.
 *
 * There are two ways to use it:
 * - Pass by pass: each pass becomes a pass of the host's graph. The host creates the resources of the list, orders the
 *   passes, places barriers and swaps histories. The library itself binds resources of kind UPLOAD and LIBRARY. The
 *   host calls walr_record_pass for each pass, which only binds and dispatches.
 * - A dispatch list: the host also creates the pipelines, from the SPIR-V and constants in the list. It may use the
 *   list's order, barriers and heap offsets as they are. It need not give a device, but then there are no heaps,
 *   because only a driver knows the sizes of images: the host gives every resource memory of its own.
 */
#ifndef WALR_WALR_PASSES_H
#define WALR_WALR_PASSES_H

#include <walr/walr.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum WalrResourceKind {
  /* An image of the host: "lighting", ..., "denoised", and with two lights "second_lighting", "second_denoised", with
   * specular light "specular_albedo", "roughness", "specular_motion". Of a single stage also its other inputs, named
   * like the ports. */
  WALR_RESOURCE_HOST = 0,
  WALR_RESOURCE_TRANSIENT = 1,        /* Lives within the frame. */
  WALR_RESOURCE_HISTORY_PREVIOUS = 2, /* What the last frame wrote into `partner`. Null in the first frame. */
  WALR_RESOURCE_HISTORY_CURRENT = 3,  /* Kept for the next frame, which reads it as `partner`. */
  /* A uniform buffer with new contents in every frame, or a storage buffer with a network's weights, which are the same
   * in all frames; see walr_get_frame_constants. */
  WALR_RESOURCE_UPLOAD = 4,
  WALR_RESOURCE_LIBRARY = 5, /* A buffer of the library, which also places its barriers: the host binds nothing. */
  WALR_RESOURCE_KIND_MAX = 0x7fffffff
} WalrResourceKind;

#define WALR_NONE 0xffffffffU

typedef struct WalrResource {
  uint32_t struct_size;
  WalrResourceKind kind;
  const char* name;
  VkBool32 used; /* Whether any pass uses it. */
  VkBool32 buffer;
  VkFormat format; /* For images only, like width, height and image_usage. */
  uint32_t width;
  uint32_t height;
  VkImageUsageFlags image_usage; /* Union over all passes. */
  VkBufferUsageFlags buffer_usage;
  uint32_t partner;     /* Index of the other resource of a history; WALR_NONE if it is none. */
  uint64_t buffer_size; /* Bytes; buffers only. */
  uint64_t memory_size; /* Bytes that the driver requires; without a device, bytes of the texels. */
  uint32_t heap;        /* Index of the heap, for transients that alias; WALR_NONE otherwise, and without a device. */
  uint32_t reserved;
  uint64_t heap_offset; /* Bytes. */
  /* For hosts that execute the list themselves: the states in which a frame must find the resource, before its first
   * barrier, and in which it leaves it, after `releases`. A barrier into `entry` has it as its destination (stage,
   * access and new layout), a barrier out of `exit` as its source. Buffers have no layout. Both are zero if the
   * resource is not used, and for WALR_RESOURCE_LIBRARY.
   * - WALR_RESOURCE_HOST: `entry` is the first use, to which all writes of the host must be visible. An output
   *   enters and leaves a frame in the same state, a write: two frames still need a barrier between them.
   * - WALR_RESOURCE_UPLOAD: likewise. What the CPU writes before the submission is visible.
   * - WALR_RESOURCE_HISTORY_PREVIOUS: `entry` equals the `exit` of the partner, in which the last frame left the image.
   *   If there is no last frame, or its history is dropped, wait for `entry`, fill the image with zeros and bring it
   *   into `entry`; its usage flags allow a clear. After walr_continue_passes the image comes from the other list:
   *   bring it from the `exit` of that list's current history into this `entry` if the two differ. Fill a history that
   *   the other list does not have with zeros.
   * - WALR_RESOURCE_HISTORY_CURRENT and WALR_RESOURCE_TRANSIENT: the layout of `entry` is UNDEFINED, because the
   *   contents are discarded. Its stage and access are the last use of the memory, also by other resources and in the
   *   frame before. Hosts that submit frames in order to one queue have nothing to do, not even in the first frame. */
  WalrImageState entry;
  WalrImageState exit;
} WalrResource;

/* One binding of a shader. All are in descriptor set 0. */
typedef struct WalrBinding {
  uint32_t struct_size;
  uint32_t binding;
  const char* name;
  VkDescriptorType type;
  uint32_t resource;           /* Index into WalrPassList::resources. A pass may bind a resource more than once. */
  VkPipelineStageFlags2 stage; /* Stages in which the pass uses it, */
  VkAccessFlags2 access;       /* and all its accesses. */
  /* The usual layout. The host may use GENERAL instead of any, and READ_ONLY_OPTIMAL instead of
   * SHADER_READ_ONLY_OPTIMAL; see WalrPassResource::layout. */
  VkImageLayout layout;
  VkFilter filter; /* For combined image samplers, which clamp to the edge. */
} WalrBinding;

/* A VkImageMemoryBarrier2 or VkBufferMemoryBarrier2 for a whole resource. */
typedef struct WalrBarrier {
  uint32_t resource;
  uint32_t alias_of; /* The resource that used the memory before, if that was another; WALR_NONE otherwise. */
  VkPipelineStageFlags2 src_stage;
  VkAccessFlags2 src_access;
  VkPipelineStageFlags2 dst_stage;
  VkAccessFlags2 dst_access;
  VkImageLayout old_layout;
  VkImageLayout new_layout;
} WalrBarrier;

typedef struct WalrSpecialization {
  uint32_t constant_id;
  uint32_t value; /* The 32 bits of a uint, float or bool. */
} WalrSpecialization;

/* The pass reads the age of a history from its push constants: the number of frames, 0 if there is none. */
typedef struct WalrHistoryAge {
  uint32_t resource; /* The previous history. */
  uint32_t offset;   /* Bytes into the push constants. */
} WalrHistoryAge;

/* One dispatch of a compute shader. */
typedef struct WalrDispatch {
  uint32_t struct_size;
  uint32_t binding_count;
  const char* name;      /* Name of the pass, unique in the list. */
  const char* shader;    /* Passes with the same shader name have the same SPIR-V. */
  const uint32_t* spirv; /* Computes in single precision, also where the device has shaderFloat16. */
  size_t spirv_size;     /* Bytes. */
  const WalrBinding* const* bindings;
  const WalrSpecialization* specializations;
  const void* push_constants;
  const WalrHistoryAge* history_ages;
  const WalrBarrier* barriers; /* To record before the dispatch, if the list's order and heaps are used. A dispatch
                                  without barriers may overlap with the one before it. */
  uint32_t specialization_count;
  uint32_t push_constant_size; /* Bytes. */
  uint32_t history_age_count;
  uint32_t barrier_count;
  uint32_t group_count[3];
  /* Index of the buffer that holds the group counts, or WALR_NONE. It is also one of the bindings, whose stage and
   * access include the indirect read. */
  uint32_t indirect;
  uint64_t indirect_offset;
} WalrDispatch;

typedef struct WalrHeap {
  uint64_t size;
  uint32_t memory_type_bits;
  uint32_t reserved;
} WalrHeap;

/* A port of a single stage: WalrPassType::ports. */
typedef struct WalrPortResource {
  const char* port;
  uint32_t resource; /* Index into WalrPassList::resources. */
  VkBool32 output;
} WalrPortResource;

typedef struct WalrPassList {
  uint32_t struct_size;
  uint32_t resource_count;
  const WalrResource* const* resources;
  const WalrDispatch* const* passes; /* In a valid order. */
  const WalrBarrier* releases;       /* To record after the last pass. */
  const WalrHeap* heaps;
  uint32_t pass_count;
  uint32_t release_count;
  uint32_t heap_count;
  uint32_t reserved;
  const WalrPortResource* ports; /* Of a single stage; a method has none. */
  uint32_t port_count;
  uint32_t reserved2;
} WalrPassList;

typedef struct WalrPasses_T* WalrPasses;

typedef struct WalrSettingValue {
  const char* name;
  const char* value;
} WalrSettingValue;

/* Format of the image that is connected to an input of a single stage, if it differs from WalrPort::format or the input
 * is optional: an optional input without an entry is not connected. The formats of the host's own images are in
 * WalrDenoiserInfo. */
typedef struct WalrPortFormat {
  const char* port;
  VkFormat format;
  uint32_t reserved;
} WalrPortFormat;

typedef struct WalrPassesInfo {
  uint32_t struct_size;
  uint32_t setting_count;
  /* `method` may be the name of any WalrPassType. `device` may be null if no pass will be recorded. */
  const WalrDenoiserInfo* denoiser;
  const WalrSettingValue* settings;
  const WalrPortFormat* ports; /* For a single stage; optional. */
  uint32_t port_count;
  uint32_t reserved;
} WalrPassesInfo;

/*
 * Create the passes of a whole method or of a single stage (a WalrPassType that is not a method). A host can build its
 * own method out of stages:
 * - Connect an output of one stage to the inputs of the same name of later stages. To do so, use the image behind the
 *   output (WalrPassList::ports) also for the WALR_RESOURCE_HOST behind the input. Create it with the combined usage
 *   flags of all these resources, and keep its contents until the last of these stages has read it.
 * - An output that is a previous history ("guides.previous-depth") holds what the last frame wrote into its partner. In
 *   the first frame and after a camera cut, give later stages an image of zeros for it.
 * - A stage takes images in walr's own conventions. Of WalrConventions it accepts only normal_space, motion_unit,
 *   motion_scale, motion_jittered, WALR_MOTION_DEPTH_STATIC_SCENE and WALR_MOTION_DEPTH_FOUND.
 * - Begin each frame of every stage with the same camera.
 */
WALR_API WalrResult walr_create_passes(const WalrPassesInfo* info, WalrPasses* passes);
/* The GPU must have finished everything recorded. */
WALR_API WalrResult walr_destroy_passes(WalrPasses passes);
/* The list and all it points to are valid until the passes are destroyed. */
WALR_API WalrResult walr_get_pass_list(WalrPasses passes, const WalrPassList** list);

/* Continue from the last frame of other passes: `passes` takes over the camera, size and frame number of `last`, and
 * the ages of its histories. A pass list never changes, so a host that changes a setting or the size creates new passes
 * and continues from the old ones. In the next frame, bind the current histories of `last` as the previous histories of
 * the same name and format; bind null if `last` has no such history. Both must be of the same method, and of the same
 * size unless both set WalrConventions::rectangle. Hosts may alternate between passes of several sizes. With
 * WalrDenoiserInfo::pipeline_cache, pipelines that `last` has need not be compiled again. */
WALR_API WalrResult walr_continue_passes(WalrPasses passes, WalrPasses last);

typedef struct WalrPassFrame {
  uint32_t struct_size;
  float sky_depth; /* As in WalrFrame. */
  const WalrCamera* camera;
  const WalrCamera* previous_camera; /* Null means the camera of the frame before. */
  float pre_exposure;                /* As in WalrFrame. */
  uint32_t flags;                    /* 0 or WALR_FRAME_INDEX_GIVEN. */
  uint32_t offset[2];                /* As in WalrFrame. */
  uint32_t frame_index;              /* As in WalrFrame. */
  uint32_t reserved;
  double origin[3]; /* As in WalrFrame. */
  double previous_origin[3];
  VkSemaphore finished; /* As in WalrFrame, checked by walr_begin_frame. Not used by passes without a device. */
  uint64_t finished_value;
  uint32_t light_offset[2]; /* As in WalrFrame. */
} WalrPassFrame;

/* Begin a frame. Call it once before the passes of the frame are recorded. The GPU must have finished the frame that
 * was begun `frames_in_flight` frames earlier. */
WALR_API WalrResult walr_begin_frame(WalrPasses passes, const WalrPassFrame* frame);

/* Contents of an upload buffer for the frame begun last, for hosts that bind their own buffer.
 * resource: index of a WALR_RESOURCE_UPLOAD
 * size: in: bytes at `bytes`; out: bytes needed. `bytes` may be null. */
WALR_API WalrResult walr_get_frame_constants(WalrPasses passes, uint32_t resource, void* bytes, size_t* size);

/* A resource that the host binds. */
typedef struct WalrPassResource {
  VkImage image;     /* Null for a previous history that does not exist: the pass reads zeros. */
  VkBuffer buffer;   /* For buffers, except WALR_RESOURCE_UPLOAD and _LIBRARY: the library binds its own. */
  uint64_t identity; /* As in WalrImage. */
  VkImageLayout layout;
  uint32_t reserved;
} WalrPassResource;

/*
 * Bind and dispatch a pass. Passes of a frame may be recorded in any order and into different command buffers, also
 * secondary ones, if the GPU executes them in the list's order or another valid one. The call records no barrier,
 * except to clear the zeros that stand in for a null history and for buffers of the library: all resources must be in
 * the given layout and visible to the binding's stage and access, and must stay so until the pass has finished.
 * resources: one for each binding of the pass, in the order of WalrDispatch::bindings
 */
WALR_API WalrResult walr_record_pass(WalrPasses passes, uint32_t pass, VkCommandBuffer command_buffer,
                                     const WalrPassResource* resources, uint32_t resource_count);

/* Destroy the views of an image; see walr_forget_image. */
WALR_API WalrResult walr_forget_pass_image(WalrPasses passes, VkImage image, uint64_t identity);

/* As walr_get_timings: GPU times of the passes of the last evaluated frame, each from the end of the commands before
 * it. A frame is evaluated when walr_begin_frame begins the one `frames_in_flight` after it. Names are valid as long as
 * the passes. */
WALR_API WalrResult walr_get_pass_timings(WalrPasses passes, uint32_t* count, WalrPassTime* times);
/* As walr_get_findings, for passes of a whole method. With WalrDenoiserInfo::lint, the list has two more passes, and
 * another one for specular light. A frame in which they are not recorded is not checked; leave them out in a frame that
 * follows a camera cut. A new finding is not logged. */
WALR_API WalrResult walr_get_pass_findings(WalrPasses passes, uint32_t* count, WalrFinding* findings);

/* As walr_get_counters, for passes of a whole method. With WalrDenoiserInfo::counters, the list has more passes; a
 * frame in which they are not recorded is not counted. */
WALR_API WalrResult walr_get_pass_counters(WalrPasses passes, uint32_t* count, WalrCounter* counters);

#ifdef __cplusplus
}
#endif
#endif
