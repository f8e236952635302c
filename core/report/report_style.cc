#include "core/report/report_parts.h"

namespace gaitmill {

const char* reportStyle() {
  return R"css(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0 auto;padding:1rem;max-width:64rem;color:#1a1a1a;background:#fff;
 font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.5rem 0}
h2{font-size:1.25rem;line-height:1.3;margin:2.2rem 0 .6rem;border-bottom:2px solid #d5dae0;
 padding-bottom:.2rem}
.subject{font-size:1.15rem;margin:.2rem 0 .8rem;overflow-wrap:anywhere}
a{color:#0b4f8a}
code{font-family:ui-monospace,"Liberation Mono",monospace;font-size:.85em;overflow-wrap:anywhere}
.verdict{display:inline-block;padding:.05em .55em;border:1px solid;border-radius:1em;
 font-size:.85em;font-weight:600;line-height:1.4;white-space:nowrap}
h2 .verdict{font-size:.7em;vertical-align:.15em}
.verdict.pass{color:#14532d;background:#e6f4ea}
.verdict.warn{color:#6b3f00;background:#fff0cf}
.verdict.fail{color:#8b1414;background:#fde5e3}
.overall{padding:.8rem 1rem;border-left:.4rem solid #9aa4ae;background:#f5f7f9;margin:1rem 0}
.overall.pass{border-color:#2e7d4a}.overall.warn{border-color:#c98500}
.overall.fail{border-color:#c62828}
table{border-collapse:collapse;width:100%;font-size:.9rem;margin:.4rem 0 1.2rem}
caption{text-align:left;font-weight:600;padding:.4rem 0}
th,td{text-align:left;vertical-align:top;padding:.35rem .6rem;border-bottom:1px solid #d5dae0}
thead th{border-bottom:2px solid #8d99a6;vertical-align:bottom}
tbody th{font-weight:400}
.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.who{display:block;color:#4a5560;font-size:.85em;white-space:normal;overflow-wrap:anywhere}
small{display:block;color:#4a5560}
.wide{overflow-x:auto}
.wide ul{margin:0;padding-left:1.1rem}
.advice td{padding:.5rem .9rem .7rem;border-left:.3rem solid #c98500;background:#fffaf0}
.advice.fail td{border-left-color:#c62828;background:#fff5f4}
.advice p{margin:.3rem 0;max-width:56rem}
.checks .verdict{margin-right:.3rem}
.checks{table-layout:fixed}
.checks thead th:nth-child(1){width:38%}.checks thead th:nth-child(5){width:27%}
.checks thead th:nth-child(n+2):nth-child(-n+4){text-align:right}
thead .number{white-space:normal}
caption{padding-top:.8rem}
dl{display:grid;grid-template-columns:repeat(auto-fill,minmax(17rem,1fr));gap:.5rem 1.5rem;margin:0}
dt{font-size:.85rem;color:#4a5560}
dd{margin:0;overflow-wrap:anywhere}
.poses{display:grid;grid-template-columns:repeat(auto-fit,minmax(13rem,1fr));gap:.8rem}
figure{margin:0}
img,svg{max-width:100%;height:auto;display:block}
figcaption{font-size:.9rem;color:#333;padding:.3rem 0}
.chart{margin:1.8rem 0}
.chart h3{font-size:1.05rem;margin:0 0 .3rem}
.chart svg{min-width:40rem}
.chart p{font-size:.9rem;color:#333;margin:.3rem 0;max-width:56rem}
pre{white-space:pre-wrap;overflow-wrap:anywhere;font-size:.8rem}
footer{margin-top:2.5rem;font-size:.9rem;color:#333}
@media (max-width:44rem){
 .checks thead{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%)}
 .checks,.checks tbody,.checks tr,.checks th,.checks td{display:block}
 .checks tr{border-bottom:1px solid #8d99a6;padding:.4rem 0}
 .checks th,.checks td{border-bottom:0;padding:.15rem .2rem;text-align:left}
 .checks td[data-column]::before{content:attr(data-column) ": ";color:#4a5560}
 .checks caption{display:block}
 .checks .who{display:inline}
 .checks .who::before{content:"("}.checks .who::after{content:")"}
 .advice td{padding:.4rem .7rem}
}
@media print{
 @page{margin:14mm 13mm}
 body{padding:0;max-width:none;font-size:9.5pt}
 h1{font-size:16pt}h2{font-size:12.5pt;break-after:avoid;margin-top:1.4em}
 table{font-size:8.5pt}
 thead{display:table-header-group}
 tr,figure,.overall,.verdict{break-inside:avoid}
 caption,thead,.chart h3{break-after:avoid}
 tbody tr:first-child,tbody tr:nth-child(2),.advice{break-before:avoid}
 th,td{padding:.25rem .45rem}
 .wide{overflow:visible}
 .poses{grid-template-columns:repeat(4,1fr)}
 details{display:none}
 .chart svg{min-width:0}
 .piece{break-inside:avoid}
 figcaption{font-size:8pt}
 a{color:inherit;text-decoration:none}
 *{print-color-adjust:exact;-webkit-print-color-adjust:exact}
}
)css";
}

}  // namespace gaitmill
