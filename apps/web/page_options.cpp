#include "apps/web/page_options.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include "apps/command_line/values.h"

namespace kaustik::app {

namespace {

int port_of(const std::string& text) {
  constexpr uint64_t kLast = 65535;
  const auto port = parse_count(text);
  if (!port || *port > kLast)
    throw OptionError("--port", fmt::format("`{}`: expected a whole number, 0 to {}", text, kLast));
  return static_cast<int>(*port);
}

std::string address_of(const std::string& text) {
  in6_addr ignored{};
  const bool number =
      inet_pton(AF_INET, text.c_str(), &ignored) == 1 || inet_pton(AF_INET6, text.c_str(), &ignored) == 1;
  if (!number)
    throw OptionError("--listen",
                      fmt::format("`{}`: expected an address of this machine by number, like 192.168.1.5, or "
                                  "0.0.0.0 for all of them",
                                  text));
  return text;
}

}  // namespace

void add_page_options(Command& command, PageOptions& options, const std::string& needs) {
  const std::vector<std::string> all_need = needs.empty() ? std::vector<std::string>{} : std::vector{needs};
  command
      .add_parsed("--port", "N", "Port of the page: 0 to 65535. Default: 0, any that is free",
                  [&options](const std::string& text) { options.port = port_of(text); })
      .needs = all_need;
  command
      .add_parsed(
          "--listen", "ADDRESS",
          "Serve the page to other machines, too, at this address of the machine; its own address then "
          "has a token that nobody can guess, but is not encrypted. Default: this machine alone",
          [&options](const std::string& text) { options.listen = address_of(text); })
      .needs = all_need;
  command
      .add_text("--reference", "FILE", options.reference,
                "A picture to compare with on the page, of the size of the picture or of its crop. EXR holds "
                "radiance; other forms are decoded from sRGB")
      .needs = all_need;
  command.add_flag("--open", options.open, "Open the page in the browser").needs = all_need;
}

}  // namespace kaustik::app
