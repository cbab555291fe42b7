/*
 * Guideway: path layouts of automated guided vehicles.
 *
 * Layouts and drawings are opaque. The caller owns what a function returns and frees it with the
 * function that its documentation names, once; NULL is freed without effect. Arguments stay the
 * caller's, and are needed during the call only. Texts are UTF-8 and end with 0.
 *
 * A function that fails returns NULL, or a status that is not GUIDEWAY_STATUS_OK, and leaves what
 * it would have written unchanged. guideway_last_error says why. NULL is refused where it has no
 * meaning. A fault of the library is such an error too; it never ends the program.
 *
 * A layout never changes: any number of threads may use it at once, and it may be freed while its
 * drawings live. Threads that use one drawing wait for each other. Callbacks run on the thread of
 * the call; they must not throw, jump out of the call, or free its arguments.
 *
 * Until version 1.0 the ABI may change with each minor version, and the name of the library too.
 */

#ifndef GUIDEWAY_H
#define GUIDEWAY_H

#include <stddef.h>
#include <stdint.h>

/* A stream of record batches: see https://arrow.apache.org/docs/format/CStreamInterface.html */
struct ArrowArrayStream;

/*
 The outcome of a call.
 */
typedef enum GuidewayStatus {
  /*
   It succeeded.
   */
  GUIDEWAY_STATUS_OK = 0,
  /*
   It failed: see `guideway_last_error`.
   */
  GUIDEWAY_STATUS_FAILED = 1,
} GuidewayStatus;

/*
 The weight of a finding.
 */
typedef enum GuidewaySeverity {
  /*
   It is a fact worth knowing.
   */
  GUIDEWAY_SEVERITY_INFO = 0,
  /*
   Something is doubtful.
   */
  GUIDEWAY_SEVERITY_WARNING = 1,
  /*
   Something is wrong.
   */
  GUIDEWAY_SEVERITY_ERROR = 2,
} GuidewaySeverity;

/*
 Kind of an element.
 */
typedef enum GuidewayElementKind {
  /*
   There is no element.
   */
  GUIDEWAY_ELEMENT_KIND_NONE = 0,
  /*
   A path.
   */
  GUIDEWAY_ELEMENT_KIND_PATH = 1,
  /*
   A node.
   */
  GUIDEWAY_ELEMENT_KIND_NODE = 2,
  /*
   A station.
   */
  GUIDEWAY_ELEMENT_KIND_STATION = 3,
} GuidewayElementKind;

/*
 A layout prepared for pictures.
 */
typedef struct GuidewayDrawing GuidewayDrawing;

/*
 A layout: paths, nodes, stations and all that a file says about them.
 */
typedef struct GuidewayLayout GuidewayLayout;

/*
 A finding. Its texts are valid during the callback.
 */
typedef struct GuidewayFinding {
  /*
   Its weight.
   */
  enum GuidewaySeverity severity;
  /*
   Line of the file, from 1; 0 if it is not known.
   */
  uint32_t line;
  /*
   Column in the line, from 1; 0 if it is not known.
   */
  uint32_t column;
  /*
   Stable name of the kind of finding, for programs.
   */
  const char *code;
  /*
   The element that it is about.
   */
  const char *element;
  /*
   The finding, without final period.
   */
  const char *message;
  /*
   The action that resolves it, without final period.
   */
  const char *remedy;
} GuidewayFinding;

/*
 Receives a finding. Returns 0 to go on, another number to stop.
 */
typedef int32_t (*GuidewayFindingCallback)(const struct GuidewayFinding *finding, void *user);

/*
 The part of a layout that a picture shows, and its size.
 */
typedef struct GuidewayView {
  /*
   The point in the middle of the picture, in meters.
   */
  double center_x_m;
  /*
   The point in the middle of the picture, in meters.
   */
  double center_y_m;
  /*
   Pixels per meter.
   */
  double px_per_m;
  /*
   Width in pixels.
   */
  uint32_t width_px;
  /*
   Height in pixels.
   */
  uint32_t height_px;
} GuidewayView;

/*
 The account of a picture: drawn + culled + hidden + refused = total.
 */
typedef struct GuidewayReport {
  /*
   Paths of the layout.
   */
  uint64_t total;
  /*
   Paths in the picture.
   */
  uint64_t drawn;
  /*
   Paths outside the view.
   */
  uint64_t culled;
  /*
   Paths of other levels.
   */
  uint64_t hidden;
  /*
   Paths that cannot be drawn: `guideway_layout_check` has the reasons.
   */
  uint64_t refused;
  /*
   Time of the call in milliseconds.
   */
  double elapsed_ms;
} GuidewayReport;

/*
 An element of a layout.
 */
typedef struct GuidewayElement {
  /*
   Its kind.
   */
  enum GuidewayElementKind kind;
  /*
   Its row in the table of its kind, from 0.
   */
  uint32_t row;
} GuidewayElement;

/*
 Why a call failed.
 */
typedef struct GuidewayError {
  /*
   Stable name of the kind of failure, for programs.
   */
  const char *code;
  /*
   The failure and its place, without final period.
   */
  const char *message;
  /*
   The action that resolves it, without final period.
   */
  const char *remedy;
} GuidewayError;

/*
 Receives the next bytes of a file. Returns 0 to go on, another number to stop.
 */
typedef int32_t (*GuidewayWriteCallback)(const uint8_t *data, size_t len, void *user);

/*
 The way a vehicle drives.
 */
typedef struct GuidewayRouteOptions {
  /*
   Its type; NULL if the layout has at most one.
   */
  const char *vehicle_type;
  /*
   Its speed on paths without a limit, in m/s; 0 for 1 m/s.
   */
  double speed_m_s;
  /*
   Its largest lateral acceleration in m/s², which slows it in bends; 0 for no limit.
   */
  double lateral_acceleration_m_s2;
} GuidewayRouteOptions;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Makes a layout of a stream of record batches, whose columns `docs/arrow-format.md` describes.
 Free the layout with `guideway_layout_free`.

 The stream is taken, also when the call fails: its `release` is NULL afterwards.
 */
struct GuidewayLayout *guideway_layout_from_arrow(struct ArrowArrayStream *stream);

/*
 Writes a stream of record batches that hold a layout to `stream`, whose old content is
 overwritten. The caller calls its `release` in the end; the stream lives on without the layout.
 */
enum GuidewayStatus guideway_layout_to_arrow(const struct GuidewayLayout *layout,
                                             struct ArrowArrayStream *stream);

/*
 Checks a layout and hands each finding to a callback, which receives `user` too: those of the
 reader, of the geometry and of the network.
 */
enum GuidewayStatus guideway_layout_check(const struct GuidewayLayout *layout,
                                          GuidewayFindingCallback callback,
                                          void *user);

/*
 Prepares pictures of a layout. Free the drawing with `guideway_drawing_free`.

 `color_by` is a column of the paths by whose values they are colored, such as "maxSpeed", and
 `level` the level to show. Either may be NULL.
 */
struct GuidewayDrawing *guideway_drawing_new(const struct GuidewayLayout *layout,
                                             const char *color_by,
                                             const char *level);

/*
 Frees a drawing.
 */
void guideway_drawing_free(struct GuidewayDrawing *drawing);

/*
 Writes the view that shows the whole layout in a picture of this size to `view`.
 */
enum GuidewayStatus guideway_drawing_fit(const struct GuidewayDrawing *drawing,
                                         uint32_t width_px,
                                         uint32_t height_px,
                                         struct GuidewayView *view);

/*
 Draws a view: red, green, blue and alpha of each pixel, rows from the top, each row
 `stride_bytes` after the one before. Bytes between the rows stay as they are. Alpha is straight.

 `background` is the color below all paths as 0xRRGGBBAA: 0xFFFFFFFF is white, 0 transparent.
 `report` may be NULL.

 `rgba` has `stride_bytes` times the height of the view bytes; of the last row, four bytes per
 pixel are enough. No other thread uses them meanwhile.
 */
enum GuidewayStatus guideway_drawing_render(struct GuidewayDrawing *drawing,
                                            const struct GuidewayView *view,
                                            uint32_t background,
                                            uint8_t *rgba,
                                            size_t stride_bytes,
                                            struct GuidewayReport *report);

/*
 Finds the station, node or path at a pixel of a view, within `reach_px` pixels, and writes it to
 `element`; its kind is GUIDEWAY_ELEMENT_KIND_NONE if there is none.

 Unless `id` is NULL it receives the identifier of the element, or NULL if there is none; free it
 with `guideway_text_free`.
 */
enum GuidewayStatus guideway_drawing_hit_test(const struct GuidewayDrawing *drawing,
                                              const struct GuidewayView *view,
                                              double x_px,
                                              double y_px,
                                              double reach_px,
                                              struct GuidewayElement *element,
                                              char **id);

/*
 Why the last call of this thread that failed did so; NULL if none failed. Calls that succeed
 leave it as it is.

 The library owns it: it is valid until the next call of this thread fails.
 */
const struct GuidewayError *guideway_last_error(void);

/*
 The version of the library, such as "0.1.0". It is not freed.
 */
const char *guideway_version(void);

/*
 Reads a file; its content decides the format. Free the layout with `guideway_layout_free`.
 */
struct GuidewayLayout *guideway_layout_open(const char *file);

/*
 Reads `len` bytes at `data`, those of a file that errors call `name`. Free the layout with
 `guideway_layout_free`.
 */
struct GuidewayLayout *guideway_layout_from_bytes(const char *name,
                                                  const uint8_t *data,
                                                  size_t len);

/*
 Frees a layout. Its drawings stay.
 */
void guideway_layout_free(struct GuidewayLayout *layout);

/*
 Format, counts, extent, levels, vehicle types and columns of a layout as JSON. Free the text
 with `guideway_text_free`.
 */
char *guideway_layout_info(const struct GuidewayLayout *layout);

/*
 Saves a layout in the format that the extension of the file names, whole or not at all.

 Unless `losses` is NULL it receives what the format cannot hold, as a JSON list of sentences;
 free it with `guideway_text_free`.
 */
enum GuidewayStatus guideway_layout_save(const struct GuidewayLayout *layout,
                                         const char *file,
                                         char **losses);

/*
 Writes a layout in a format, such as "lif", "geojson" or "opentcs", piece by piece to a
 callback, which receives `user` too. `losses` is as in `guideway_layout_save`.
 */
enum GuidewayStatus guideway_layout_write(const struct GuidewayLayout *layout,
                                          const char *format,
                                          GuidewayWriteCallback callback,
                                          void *user,
                                          char **losses);

/*
 Frees a text that a function returned.
 */
void guideway_text_free(char *text);

/*
 The fastest route from one station or node to another one, as JSON: its length and time, and its
 paths in order. NULL if there is none. `options` may be NULL. Free the text with
 `guideway_text_free`.
 */
char *guideway_layout_route(const struct GuidewayLayout *layout,
                            const char *start,
                            const char *goal,
                            const struct GuidewayRouteOptions *options);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* GUIDEWAY_H */
