// Finds a route, hands the layout over as tables of Apache Arrow and makes a layout of them again,
// and finds the element under a pointer:
//
//     c++ -std=c++17 tables.cpp $(pkg-config --cflags --libs guideway) -o tables
//     ./tables site.lif.json dock-1 dock-3
//
// A program with Apache Arrow takes the stream by arrow::ImportRecordBatchReader.

#include <guideway.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// The structure of the Arrow C stream interface.
struct ArrowArrayStream {
    int (*get_schema)(ArrowArrayStream *, struct ArrowSchema *);
    int (*get_next)(ArrowArrayStream *, struct ArrowArray *);
    const char *(*get_last_error)(ArrowArrayStream *);
    void (*release)(ArrowArrayStream *);
    void *private_data;
};

struct Free {
    void operator()(GuidewayLayout *layout) const { guideway_layout_free(layout); }
    void operator()(GuidewayDrawing *drawing) const { guideway_drawing_free(drawing); }
    void operator()(char *text) const { guideway_text_free(text); }
};
template <typename T> using Owned = std::unique_ptr<T, Free>;

[[noreturn]] static void fail()
{
    const GuidewayError *error = guideway_last_error();
    throw std::runtime_error(std::string(error->message) + ". " + error->remedy);
}

static void demand(GuidewayStatus status)
{
    if (status != GUIDEWAY_STATUS_OK)
        fail();
}

template <typename T> static Owned<T> owned(T *made)
{
    if (!made)
        fail();
    return Owned<T>(made);
}

static int32_t append(const uint8_t *data, size_t len, void *user)
{
    auto &bytes = *static_cast<std::vector<uint8_t> *>(user);
    bytes.insert(bytes.end(), data, data + len);
    return 0;
}

static void run(const char *file, const char *start, const char *goal)
{
    auto layout = owned(guideway_layout_open(file));
    GuidewayRouteOptions options{"tugger-3000", 1.0, 0.0};
    std::printf("%s\n", owned(guideway_layout_route(layout.get(), start, goal, &options)).get());

    ArrowArrayStream stream{};
    demand(guideway_layout_to_arrow(layout.get(), &stream));
    layout = owned(guideway_layout_from_arrow(&stream));
    if (stream.release)
        throw std::logic_error("the stream was not taken");

    std::vector<uint8_t> bytes;
    demand(guideway_layout_write(layout.get(), "geojson", append, &bytes, nullptr));
    auto again = owned(guideway_layout_from_bytes("site.geojson", bytes.data(), bytes.size()));

    auto drawing = owned(guideway_drawing_new(again.get(), nullptr, nullptr));
    GuidewayView view;
    demand(guideway_drawing_fit(drawing.get(), 640, 360, &view));
    GuidewayElement element;
    char *id = nullptr;
    demand(guideway_drawing_hit_test(drawing.get(), &view, 320, 180, 1000, &element, &id));
    Owned<char> name(id);
    std::printf("kind %d, row %u: %s\n", element.kind, element.row, id ? id : "none");
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        std::fprintf(stderr, "write: tables LAYOUT START GOAL\n");
        return 1;
    }
    try {
        run(argv[1], argv[2], argv[3]);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
