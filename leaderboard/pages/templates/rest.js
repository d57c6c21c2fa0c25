{% set html %}{% include "rows.html" %}{% endset %}
window.coliftRows = {{ {"html": html, "rows": view.data.rows}|data }};
