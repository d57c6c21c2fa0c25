{% set html %}{% include "rows.html" %}{% endset %}
window.coliftRows = {{ {"html": html, "rows": data.rows}|data }};
