// Only elements marked by pymdownx.arithmatex contain equations.
window.MathJax = {
  tex2jax: {
    inlineMath: [['\\(', '\\)']],
    displayMath: [['\\[', '\\]']],
    ignoreClass: '.*|',
    processClass: 'arithmatex',
  },
  messageStyle: 'none',
  showMathMenu: false,
};
