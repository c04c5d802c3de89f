#include "vispline/report/html_style.h"

#include "vispline/report/number.h"
#include "vispline/report/sha256.h"

namespace vispline::report {

std::string_view page_style() {
  return R"css(
:root{color-scheme:light dark;--paper:#fff;--ink:#1b1f24;--soft:#59636e;--line:#dfe3e8;--faint:#f5f7f9;--link:#0072b2}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);
font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
body>*{max-width:55rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:3rem}
h1{margin:0;font-size:2rem;line-height:1.2;letter-spacing:-.015em;overflow-wrap:anywhere}
h2{margin:3.25rem 0 .75rem;padding-top:1.25rem;border-top:1px solid var(--line);font-size:1.3rem;line-height:1.3;
letter-spacing:-.01em;overflow-wrap:anywhere}
p{margin:.75rem 0;max-width:42rem;overflow-wrap:anywhere}
a{color:var(--link);text-decoration:none}
a:hover{text-decoration:underline}
.subtitle{margin:.5rem 0 0;color:var(--soft);font-size:1.1rem}
nav{margin-top:1.5rem}
nav ol{display:flex;flex-wrap:wrap;gap:.25rem 1.5rem;margin:0;padding:0;list-style:none;font-size:.95rem}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(11rem,50% - .4rem),1fr));gap:.75rem;margin:1.25rem 0}
.card{padding:.9rem 1.1rem;background:var(--faint);border-radius:.6rem}
.card b{display:block;font-size:1.5rem;white-space:nowrap;overflow-x:auto;font-weight:600;line-height:1.25;letter-spacing:-.01em;
font-variant-numeric:tabular-nums}
.card i{font-size:1rem;font-style:normal;font-weight:400;color:var(--soft)}
.card span{display:block;margin-top:.15rem;color:var(--soft);font-size:.9rem;line-height:1.35;overflow-wrap:anywhere}
figure{margin:1.5rem 0 2rem}
figcaption,caption{color:var(--soft);font-size:.9rem;line-height:1.45;text-align:left;overflow-wrap:anywhere}
figcaption{margin-top:.5rem;max-width:42rem}
caption{padding-bottom:.5rem}
.plots{display:flex;flex-wrap:wrap;gap:1.25rem;align-items:flex-end}
.plots>*{flex:1 1 19rem;min-width:0}
.plot{display:block;width:100%;height:auto}
.narrow{display:none}
.scroll{overflow-x:auto;margin:1.5rem 0 2rem}
table{border-collapse:collapse;width:100%;font-size:.92rem;line-height:1.35}
th,td{padding:.42rem 1.25rem .42rem 0;text-align:left;vertical-align:baseline;border-bottom:1px solid var(--line)}
th:last-child,td:last-child{padding-right:.25rem}
th{font-weight:500}
thead th{vertical-align:bottom;color:var(--soft);border-bottom-color:var(--soft)}
thead span{display:block;font-size:.85em;font-weight:400}
.num{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
thead .num{white-space:normal}
tbody tr:hover{background:var(--faint)}
footer{margin-top:4rem;padding-top:1rem;padding-bottom:3rem;color:var(--soft);font-size:.85rem}
footer p{margin:.35rem 0;max-width:none}
code{font:.95em/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;overflow-wrap:anywhere}
pre{margin:1rem 0 1.5rem;padding:.9rem 1.1rem;overflow-x:auto;background:var(--faint);border-radius:.6rem;tab-size:14;
font:.82rem/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace}
@media (max-width:38rem){header{padding-top:1.5rem}h1{font-size:1.6rem}h2{margin-top:2.25rem}
.card{padding:.75rem .85rem}.card b{font-size:1.2rem}.card i{font-size:.9rem}
.wide{display:none}.narrow{display:block}}
@media screen and (prefers-color-scheme:dark){
:root{--paper:#14181d;--ink:#e6e9ec;--soft:#9aa5b1;--line:#2c343d;--faint:#1c222a;--link:#56b4e9}
.paper{fill:#14181d}.ink{fill:#e6e9ec}.soft{fill:#9aa5b1}.halo{fill:#e6e9ec;stroke:#14181d}
.grid{stroke:#2c343d}.minor{stroke:#20262e}.axis{stroke:#66717d}
.c0{color:#3d9fdc}.c1{color:#ee7733}.c2{color:#1fbf92}.c3{color:#d993b9}.c5{color:#a9dcfa}.c6{color:#c3cad2}.c7{color:#a98bc4}
.cg{color:#6c7681}}
@media print{:root{color-scheme:light}body{font-size:11pt}body>*{max-width:none}a{color:inherit}
h2{break-after:avoid;margin-top:1.5rem}figure,tr,.cards{break-inside:avoid}thead{display:table-header-group}
.wide{display:block}.narrow{display:none}.scroll{overflow:visible}}
)css";
}

std::string content_security_policy() {
  const auto digest = sha256(page_style());
  return joined({"default-src 'none'; style-src 'sha256-", base64(digest), "'; img-src data:"});
}

}  // namespace vispline::report
